#include "hiac/cluster/edged_message.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

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

void put_stop(ByteWriter& to, const EdgeStop& stop) {
  to.put(stop.pixel);
  to.put(static_cast<std::uint8_t>(stop.enters));
  to.put(stop.t);
  to.put(stop.middle);
  to.put(stop.front_face);
  to.put(stop.back_face);
}

EdgeStop get_stop(ByteReader& from) {
  EdgeStop stop{};
  stop.pixel = from.get<std::uint32_t>();
  stop.enters = from.get<std::uint8_t>() != 0;
  stop.t = from.get<double>();
  stop.middle = from.get<double>();
  stop.front_face = from.get<std::array<std::uint64_t, 4>>();
  stop.back_face = from.get<std::array<std::uint64_t, 4>>();
  return stop;
}

void put_fragment(ByteWriter& to, const EdgeFragment& fragment) {
  to.put(fragment.pixel);
  to.put(fragment.share);
  to.put(fragment.t);
  to.put(fragment.edge);
  to.put(fragment.node);
}

EdgeFragment get_fragment(ByteReader& from) {
  EdgeFragment fragment{};
  fragment.pixel = from.get<std::uint32_t>();
  fragment.share = from.get<double>();
  fragment.t = from.get<double>();
  fragment.edge = from.get<std::array<std::uint64_t, 2>>();
  fragment.node = from.get<std::uint64_t>();
  return fragment;
}

}  // namespace

void put_edged(ByteWriter& to, const EdgedTile& tile) {
  for (const std::size_t count : {tile.segments.size(), tile.stops.size(), tile.fragments.size()})
    to.put(static_cast<std::uint32_t>(count));
  for (const EdgedSegment& segment : tile.segments) put_segment(to, segment);
  for (const EdgeStop& stop : tile.stops) put_stop(to, stop);
  for (const EdgeFragment& fragment : tile.fragments) put_fragment(to, fragment);
}

EdgedTile get_edged(ByteReader& from) {
  const auto counts = from.get_all<std::uint32_t>(3);
  EdgedTile tile;
  for (std::uint32_t k = 0; k < counts[0]; ++k) tile.segments.push_back(get_segment(from));
  for (std::uint32_t k = 0; k < counts[1]; ++k) tile.stops.push_back(get_stop(from));
  for (std::uint32_t k = 0; k < counts[2]; ++k) tile.fragments.push_back(get_fragment(from));
  return tile;
}

}  // namespace hiac
