#pragma once

#include <cstddef>
#include <vector>

#include "hiac/geometry/interval.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The finite values of a scalar field that belong to cells: of nodes, those that a cell has.
std::vector<double> values_in_cells(const ZooMesh& mesh, const Field& field);

/// Whether all values of a scalar field that belong to cells are finite.
bool is_finite_in_cells(const ZooMesh& mesh, const Field& field);

/// The smallest and the largest of values; empty where there are none.
Interval extent_of(const std::vector<double>& values);

/// Where a percentile lies among sorted values: at the rank `below`, and `share` of the way from it
/// to the next one.
struct PercentileRank {
  std::size_t below;
  double share;
};

/// `count` is positive.
PercentileRank percentile_rank(double percent, std::size_t count);

/// The percentile of values (reordered), linear between the two nearest ranks; `values` is not
/// empty.
double percentile(std::vector<double>& values, double percent);

}  // namespace hiac
