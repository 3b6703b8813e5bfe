#include "hiac/scene/paraview/scalar_axis.hpp"

namespace hiac::paraview {

ScalarAxis axis_of(const Proxy& function, double low, double high) {
  if (!function.flag("UseLogScale") || !(low < high)) return {};
  if (high < 0)
    function.fail("UseLogScale", "a logarithmic scale of negative scalars is not read here");
  if (!(low > 0)) return {};
  return {std::array{low, high}};
}

}  // namespace hiac::paraview
