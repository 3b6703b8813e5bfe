#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_container.hpp"
#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// A visibility order, with the hashes of the mesh and the view that it belongs to.
struct OrderRecord {
  std::string mesh_hash;  ///< content_hash of the mesh
  std::string view_hash;  ///< view_hash of the scene
  VisibilityOrder order;
};

/// The type of the container chunk that holds an order; order-chunk.md describes its layout.
inline constexpr const char* kOrderChunk = "ORDER";

/// The head of an order's chunk: what the order belongs to and how it was computed.
struct OrderHead {
  std::string mesh_hash, view_hash, algorithm;
  std::uint64_t cell_count = 0, group_count = 0;
};

ExtraChunk encode_order(const OrderRecord& record);

/// Throws InputError(subject, ...) if the chunk's length differs from what its head implies.
OrderHead decode_order_head(const ExtraChunk& chunk, const std::string& subject);

/// Throws InputError(subject, ...) unless the chunk lists each cell exactly once and its groups are
/// disjoint.
OrderRecord decode_order(const ExtraChunk& chunk, const std::string& subject);

/// Writes an order file: a zoo container without a mesh, with one order or with several, as for the
/// frames of an animation. On failure it throws InputError and leaves no partial file.
void write_order_file(const std::string& path, const OrderRecord& record);

/// Writes all orders that `next` returns until it returns none; only one is in memory at a time.
void write_order_file(const std::string& path,
                      const std::function<std::optional<OrderRecord>()>& next);

/// Returns the chunks that hold orders, at least one, in an order file or in a container that also
/// holds a mesh. Throws InputError.
std::vector<ExtraChunk> read_order_chunks(const std::string& path);

/// Returns the order of a file that holds exactly one. Throws InputError.
OrderRecord read_order_file(const std::string& path);

}  // namespace hiac
