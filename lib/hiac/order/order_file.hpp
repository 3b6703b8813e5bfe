#pragma once

#include <string>
#include <vector>

#include "hiac/mesh/zoo_container.hpp"
#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// A visibility order and what it belongs to.
struct OrderRecord {
  std::string mesh_hash;  ///< content_hash of the mesh
  std::string view_hash;  ///< view_hash of the scene
  VisibilityOrder order;
};

/// The type of the container chunk that holds an order; order-chunk.md tells its layout.
inline constexpr const char* kOrderChunk = "ORDER";

ExtraChunk encode_order(const OrderRecord& record);

/// Throws InputError(subject, ...) unless the chunk holds each of its cells once, in groups that
/// lie apart.
OrderRecord decode_order(const ExtraChunk& chunk, const std::string& subject);

/// An order file: a zoo container without a mesh. read_order_file also takes a container that
/// holds a mesh as well. Throws InputError.
void write_order_file(const std::string& path, const OrderRecord& record);
OrderRecord read_order_file(const std::string& path);

}  // namespace hiac
