#include "hiac/cluster/edged_message.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hiac/base/special_values.hpp"

namespace hiac {
namespace {

constexpr std::size_t kSegmentNumbers = 17;

void put_segment(ByteWriter& to, const EdgedSegment& s) {
  const SegmentDetails& d = s.details;
  to.put(s.pixel);
  to.put(static_cast<std::uint8_t>(s.phase));
  to.put(static_cast<std::uint8_t>(d.part));
  const std::array<double, kSegmentNumbers> numbers{s.middle,
                                                    s.front,
                                                    s.back,
                                                    s.light.rgb[0],
                                                    s.light.rgb[1],
                                                    s.light.rgb[2],
                                                    s.light.transparency,
                                                    d.front,
                                                    d.back,
                                                    d.light,
                                                    d.transparency,
                                                    d.first,
                                                    d.mean,
                                                    d.radiance_error,
                                                    d.transparency_error,
                                                    d.front_edge,
                                                    d.back_edge};
  to.put_all(std::span<const double>(numbers));
}

EdgedSegment get_segment(ByteReader& from) {
  EdgedSegment s{};
  s.pixel = from.get<std::uint32_t>();
  s.phase = static_cast<EdgedPhase>(from.get<std::uint8_t>());
  const auto part = static_cast<RayPart>(from.get<std::uint8_t>());
  const auto n = from.get_all<double>(kSegmentNumbers);
  s.middle = n[0];
  s.front = n[1];
  s.back = n[2];
  s.light = {{n[3], n[4], n[5]}, n[6]};
  s.details = {n[7], n[8], n[9], n[10], n[11], n[12], part, n[13], n[14], n[15], n[16]};
  return s;
}

void put_stop(ByteWriter& to, const EdgeStop& stop, bool with_reference) {
  to.put(stop.t);
  to.put(stop.face);
  to.put(stop.corners);
  if (with_reference) to.put_all(std::span<const double>(stop.reference));
}

EdgeStop get_stop(ByteReader& from, bool with_reference) {
  EdgeStop stop{};
  stop.t = from.get<double>();
  stop.face = from.get<std::uint8_t>();
  stop.corners = from.get<std::array<std::uint64_t, 4>>();
  stop.reference.fill(kNaN);
  if (with_reference) stop.reference = from.get<std::array<double, 3>>();
  return stop;
}

void put_crossing(ByteWriter& to, const EdgedCrossing& crossing) {
  const bool is_curved = crossing.shape != EdgedCrossing::kPlanar;
  to.put(crossing.pixel);
  to.put(crossing.shape);
  to.put(static_cast<std::uint8_t>(crossing.kind));
  to.put(crossing.middle);
  put_stop(to, crossing.front, is_curved);
  put_stop(to, crossing.back, is_curved);
}

EdgedCrossing get_crossing(ByteReader& from) {
  EdgedCrossing crossing{};
  crossing.pixel = from.get<std::uint32_t>();
  crossing.shape = from.get<std::uint32_t>();
  crossing.kind = static_cast<CellKind>(from.get<std::uint8_t>());
  crossing.middle = from.get<double>();
  const bool is_curved = crossing.shape != EdgedCrossing::kPlanar;
  crossing.front = get_stop(from, is_curved);
  crossing.back = get_stop(from, is_curved);
  return crossing;
}

void put_mapped(ByteWriter& to, const MappedCell& shape) {
  to.put(static_cast<std::uint8_t>(shape.kind));
  for (const CellMap::Point& node : std::span(shape.nodes).first(node_count(shape.kind)))
    to.put_all(std::span<const double>(node));
}

MappedCell get_mapped(ByteReader& from) {
  MappedCell shape{static_cast<CellKind>(from.get<std::uint8_t>()), {}};
  for (CellMap::Point& node : std::span(shape.nodes).first(node_count(shape.kind)))
    node = from.get<CellMap::Point>();
  return shape;
}

void put_fragment(ByteWriter& to, const EdgeFragment& f) {
  to.put(f.pixel);
  to.put_all(std::span<const double>(std::array{f.share, f.t, f.strip.x0, f.strip.y0, f.strip.x1,
                                                f.strip.y1, f.strip.width, f.place.along}));
  to.put(f.place.edge);
  to.put(f.place.node);
}

EdgeFragment get_fragment(ByteReader& from) {
  EdgeFragment fragment{};
  fragment.pixel = from.get<std::uint32_t>();
  const auto n = from.get<std::array<double, 8>>();
  fragment.share = n[0];
  fragment.t = n[1];
  fragment.strip = {n[2], n[3], n[4], n[5], n[6]};
  fragment.place.along = n[7];
  fragment.place.edge = from.get<std::array<std::uint64_t, 2>>();
  fragment.place.node = from.get<std::uint64_t>();
  return fragment;
}

}  // namespace

void put_edged(ByteWriter& to, const EdgedTile& tile) {
  for (const std::size_t count : {tile.segments.size(), tile.crossings.rays.size(),
                                  tile.crossings.shapes.size(), tile.fragments.size()})
    to.put(static_cast<std::uint32_t>(count));
  for (const EdgedSegment& segment : tile.segments) put_segment(to, segment);
  for (const EdgedCrossing& crossing : tile.crossings.rays) put_crossing(to, crossing);
  for (const MappedCell& shape : tile.crossings.shapes) put_mapped(to, shape);
  for (const EdgeFragment& fragment : tile.fragments) put_fragment(to, fragment);
}

EdgedTile get_edged(ByteReader& from) {
  const auto counts = from.get_all<std::uint32_t>(4);
  EdgedTile tile;
  for (std::uint32_t k = 0; k < counts[0]; ++k) tile.segments.push_back(get_segment(from));
  for (std::uint32_t k = 0; k < counts[1]; ++k) tile.crossings.rays.push_back(get_crossing(from));
  for (std::uint32_t k = 0; k < counts[2]; ++k) tile.crossings.shapes.push_back(get_mapped(from));
  for (std::uint32_t k = 0; k < counts[3]; ++k) tile.fragments.push_back(get_fragment(from));
  return tile;
}

}  // namespace hiac
