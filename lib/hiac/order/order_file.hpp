#pragma once

#include <cstdint>
#include <functional>
#include <optional>
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

/// What an order belongs to and how it was made, as the head of its chunk tells.
struct OrderHead {
  std::string mesh_hash, view_hash, algorithm;
  std::uint64_t cell_count = 0, group_count = 0;
};

ExtraChunk encode_order(const OrderRecord& record);

/// Throws InputError(subject, ...) unless the chunk is as long as its head says.
OrderHead decode_order_head(const ExtraChunk& chunk, const std::string& subject);

/// Throws InputError(subject, ...) unless the chunk holds each of its cells once, in groups that
/// lie apart.
OrderRecord decode_order(const ExtraChunk& chunk, const std::string& subject);

/// An order file: a zoo container without a mesh, of one order or of several, as for the frames of
/// an animation. Whole or not at all; throws InputError.
void write_order_file(const std::string& path, const OrderRecord& record);

/// The same with all orders that `next` returns, one after another; none is kept.
void write_order_file(const std::string& path,
                      const std::function<std::optional<OrderRecord>()>& next);

/// The chunks that hold orders in an order file, or in a container that holds a mesh as well; at
/// least one. Throws InputError.
std::vector<ExtraChunk> read_order_chunks(const std::string& path);

/// The order of a file that holds one order. Throws InputError.
OrderRecord read_order_file(const std::string& path);

}  // namespace hiac
