#include "hiac/scene/extinction_source.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "hiac/scene/transfer_points.hpp"

namespace hiac {
namespace {

using Text = std::optional<std::string>;

constexpr SpecKey<ExtinctionSource> kExtinctionKeys[] = {
    {"field", "a field of the mesh, the same or another one", true,
     [](const SpecValue& v, ExtinctionSource& e) { e.transfer.field = v.text(); },
     [](const ExtinctionSource& e) -> Text { return toml_text(e.transfer.field); }},
    {"points", "scalar, extinction coefficient per world unit of length", true,
     [](const SpecValue& v, ExtinctionSource& e) { read_points<1>(v, e.transfer.points); },
     [](const ExtinctionSource& e) -> Text { return points_text<1>(e.transfer.points); }},
    {"range", "[low, high], \"auto\" or \"percentile:1,99\": the points' scalars go from 0 to 1",
     false, [](const SpecValue& v, ExtinctionSource& e) { read_range(v, e.range); }, nullptr},
    {"scale", "\"linear\" or \"log\": in what the function is linear between points", false,
     [](const SpecValue& v, ExtinctionSource& e) { read_scale(v, e.range); }, nullptr},
};

}  // namespace

std::span<const SpecKey<ExtinctionSource>> extinction_keys() { return kExtinctionKeys; }

ExtinctionTransfer read_extinction_transfer(const SpecValue& table) {
  ExtinctionSource source;
  read_keys(table, extinction_keys(), source);
  TransferPoints<1> points = std::exchange(source.transfer.points, {});
  check_points<1>(table, points, source.range);
  double largest = 0;
  for (const auto& point : points) largest = std::max(largest, point.value[0]);
  // without any extinction no error is to be limited
  const double tolerance = largest > 0 ? kExtinctionTolerance * largest : 1;
  table.context().extinction =
      place_points<1>(std::move(points), source.range, tolerance, source.transfer.points);
  return source.transfer;
}

}  // namespace hiac
