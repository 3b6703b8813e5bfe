#include "hiac/order/order_file.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <span>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

constexpr std::uint32_t kVersion = 1;

// The start of the payload. The cells follow, then zeros up to a multiple of 64, then the groups.
struct OrderHeader {
  std::uint32_t version;
  std::uint32_t zero;
  std::uint64_t cell_count;
  std::uint64_t group_count;
  std::array<char, 32> mesh_hash;
  std::array<char, 32> view_hash;
  std::array<char, 40> algorithm;
};
static_assert(sizeof(OrderHeader) == 128);

std::uint64_t groups_offset(std::uint64_t cell_count) {
  return sizeof(OrderHeader) + (cell_count * sizeof(CellId) + 63) / 64 * 64;
}

template <std::size_t N>
std::array<char, N> text(const std::string& value) {
  std::array<char, N> fixed{};
  std::copy_n(value.begin(), std::min(value.size(), N), fixed.begin());
  return fixed;
}

template <std::size_t N>
std::string text(const std::array<char, N>& fixed) {
  return {fixed.begin(), std::find(fixed.begin(), fixed.end(), '\0')};
}

// A typed view of part of a payload, which keeps the payload alive.
template <typename T>
SharedArray<T> array_at(const SharedArray<std::uint8_t>& payload, std::uint64_t offset,
                        std::uint64_t count) {
  const auto* data = reinterpret_cast<const T*>(payload.data() + offset);
  return {std::span<const T>(data, count), std::make_shared<SharedArray<std::uint8_t>>(payload)};
}

// Returns the head of a payload, after checking that the payload has the length that it implies.
OrderHeader checked_header(const SharedArray<std::uint8_t>& payload, const std::string& subject) {
  OrderHeader header;
  if (payload.size() < sizeof header)
    throw InputError(subject,
                     fmt::format("chunk ORDER is too short (at least {} bytes expected, {} "
                                 "found)",
                                 sizeof header, payload.size()));
  std::memcpy(&header, payload.data(), sizeof header);
  if (header.version != kVersion)
    throw InputError(subject, fmt::format("unknown version of chunk ORDER ({} expected, {} found)",
                                          kVersion, header.version));
  const std::uint64_t most = payload.size() / sizeof(CellId);
  if (header.cell_count > most || header.group_count > most ||
      groups_offset(header.cell_count) + header.group_count * sizeof(CellGroup) != payload.size())
    throw InputError(subject, fmt::format("chunk ORDER has a wrong size for {} cells and {} groups "
                                          "({} bytes found)",
                                          header.cell_count, header.group_count, payload.size()));
  return header;
}

void check_permutation(std::span<const CellId> cells, const std::string& subject) {
  std::vector<bool> seen(cells.size(), false);
  for (const CellId cell : cells) {
    if (cell >= cells.size() || seen[cell])
      throw InputError(subject, fmt::format("not an order: cell {} of {} is {}", cell, cells.size(),
                                            cell >= cells.size() ? "unknown" : "there twice"));
    seen[cell] = true;
  }
}

void check_groups(std::span<const CellGroup> groups, std::uint64_t cells,
                  const std::string& subject) {
  std::uint64_t free_from = 0;
  for (const CellGroup& group : groups) {
    const std::uint64_t end = std::uint64_t{group.first} + group.count;
    if (group.first < free_from || group.count < 2 || end > cells)
      throw InputError(subject, fmt::format("not an order: impossible group ({} cells from {})",
                                            group.count, group.first));
    free_from = end;
  }
}

}  // namespace

ExtraChunk encode_order(const OrderRecord& record) {
  const auto cells = record.order.cells.view();
  const auto groups = record.order.groups.view();
  const OrderHeader header{kVersion,
                           0,
                           cells.size(),
                           groups.size(),
                           text<32>(record.mesh_hash),
                           text<32>(record.view_hash),
                           text<40>(record.order.algorithm)};
  std::vector<std::uint8_t> payload(groups_offset(cells.size()) + groups.size_bytes(), 0);
  std::memcpy(payload.data(), &header, sizeof header);
  if (!cells.empty()) std::memcpy(payload.data() + sizeof header, cells.data(), cells.size_bytes());
  if (!groups.empty())
    std::memcpy(payload.data() + groups_offset(cells.size()), groups.data(), groups.size_bytes());
  return {kOrderChunk, std::move(payload)};
}

OrderHead decode_order_head(const ExtraChunk& chunk, const std::string& subject) {
  const OrderHeader header = checked_header(chunk.payload, subject);
  return {text(header.mesh_hash), text(header.view_hash), text(header.algorithm), header.cell_count,
          header.group_count};
}

OrderRecord decode_order(const ExtraChunk& chunk, const std::string& subject) {
  const auto& payload = chunk.payload;
  const OrderHeader header = checked_header(payload, subject);
  OrderRecord record{text(header.mesh_hash), text(header.view_hash), {}};
  record.order.algorithm = text(header.algorithm);
  record.order.cells = array_at<CellId>(payload, sizeof header, header.cell_count);
  record.order.groups =
      array_at<CellGroup>(payload, groups_offset(header.cell_count), header.group_count);
  check_permutation(record.order.cells, subject);
  check_groups(record.order.groups, header.cell_count, subject);
  return record;
}

void write_order_file(const std::string& path, const OrderRecord& record) {
  write_extra_chunks(path, {encode_order(record)});
}

void write_order_file(const std::string& path,
                      const std::function<std::optional<OrderRecord>()>& next) {
  write_extra_chunks(path, [&]() -> std::optional<ExtraChunk> {
    const auto record = next();
    if (!record) return std::nullopt;
    return encode_order(*record);
  });
}

std::vector<ExtraChunk> read_order_chunks(const std::string& path) {
  std::vector<ExtraChunk> chunks = read_extra_chunks(path);
  std::erase_if(chunks, [](const ExtraChunk& chunk) { return chunk.type != kOrderChunk; });
  if (chunks.empty()) throw InputError(path, "holds no visibility order (a chunk ORDER expected)");
  return chunks;
}

OrderRecord read_order_file(const std::string& path) {
  const std::vector<ExtraChunk> chunks = read_order_chunks(path);
  if (chunks.size() > 1)
    throw InputError(path, fmt::format("holds the orders of several views (one expected, {} found)",
                                       chunks.size()));
  return decode_order(chunks.front(), path);
}

}  // namespace hiac
