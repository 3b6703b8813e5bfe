#include "formats/cgns/zone.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "hiac/base/special_values.hpp"

namespace hiac::formats::cgns {
namespace {

/// The interior values of an array of a structured zone that has extra layers (rind) around it.
std::vector<double> inner(const std::vector<double>& all, const std::array<std::size_t, 3>& extents,
                          const Rind& rind) {
  const std::size_t ni = extents[0] + rind[0] + rind[1];
  const std::size_t nj = extents[1] + rind[2] + rind[3];
  std::vector<double> values;
  values.reserve(extents[0] * extents[1] * extents[2]);
  for (std::size_t k = 0; k < extents[2]; ++k)
    for (std::size_t j = 0; j < extents[1]; ++j)
      for (std::size_t i = 0; i < extents[0]; ++i)
        values.push_back(all[i + rind[0] + ni * (j + rind[2] + nj * (k + rind[4]))]);
  return values;
}

}  // namespace

Rind rind_of(const CgnsFile& file, const Node& parent) {
  Rind rind{};
  const auto node = file.labelled(parent, "Rind_t");
  if (!node) return rind;
  const std::vector<std::int64_t> layers = file.integers(*node);
  for (std::size_t i = 0; i < std::min<std::size_t>(layers.size(), 6); ++i) {
    if (layers[i] < 0 || layers[i] > 1000) file.fail(*node, "has no sensible layers");
    rind[i] = static_cast<std::size_t>(layers[i]);
  }
  return rind;
}

std::vector<std::vector<double>> values_in(const CgnsFile& file, const Zone& zone,
                                           const FieldPart& part, FieldLocation location) {
  std::array<std::size_t, 3> extents{};
  std::size_t expected = location == FieldLocation::node ? zone.points : zone.numbered;
  if (zone.structured) {
    for (std::size_t d = 0; d < 3; ++d)
      extents[d] = zone.block.points[d] - (location == FieldLocation::cell ? 1 : 0);
    expected = 1;
    for (std::size_t d = 0; d < 3; ++d)
      expected *= extents[d] + part.rind[2 * d] + part.rind[2 * d + 1];
  }
  std::vector<std::vector<double>> columns;
  for (const Node& array : part.arrays) {
    std::vector<double> values = file.reals(array);
    if (values.size() != expected)
      file.fail(array, fmt::format("holds {} values ({} expected)", values.size(), expected));
    if (zone.structured) {
      values = inner(values, extents, part.rind);
    } else if (location == FieldLocation::cell) {
      std::vector<double> of_cells;
      for (const std::size_t number : zone.numbers)
        of_cells.push_back(number < values.size() ? values[number] : kNaN);
      values = std::move(of_cells);
    }
    columns.push_back(std::move(values));
  }
  return columns;
}

}  // namespace hiac::formats::cgns
