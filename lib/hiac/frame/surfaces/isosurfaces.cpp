#include "hiac/frame/surfaces/isosurfaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "hiac/base/parallel.hpp"
#include "hiac/element/cell_field.hpp"
#include "hiac/frame/surfaces/touched_faces.hpp"

namespace hiac {
namespace {

constexpr std::size_t kIsosurfacesGrain = std::size_t{1} << 14;

// The cuts of some consecutive cells.
struct CellCuts {
  std::vector<std::uint32_t> count;  // number of cuts, by cell
  std::vector<IsosurfaceCut> cuts;
  std::vector<TouchedFace> touched;  // `cut` counts from these cells' first
};

// Whether a cell with values between `least` and `most` meets the surface; if the value is `most`,
// the surface is only touched from below.
bool is_met(const FrameIsosurface& surface, double least, double most) {
  return least < surface.value && surface.value <= most;
}

class CutFinder {
 public:
  CutFinder(const ZooMesh& mesh, const Isosurfaces& all)
      : mesh_(mesh), all_(all), values_(all.fields.size()) {}

  CellCuts find(IndexRange cells) {
    CellCuts result;
    for (std::size_t cell = cells.begin; cell < cells.end; ++cell) {
      const std::size_t before = result.cuts.size();
      add_cell(static_cast<CellId>(cell), result);
      result.count.push_back(static_cast<std::uint32_t>(result.cuts.size() - before));
    }
    return result;
  }

 private:
  void add_cell(CellId cell, CellCuts& result) {
    if (lies_between_surfaces(cell)) return;
    for (std::size_t f = 0; f < all_.fields.size(); ++f)
      values_[f] = cell_field(mesh_, cell, all_.fields[f]);
    for (std::uint32_t s = 0; s < all_.surfaces.size(); ++s) {
      const FrameIsosurface& surface = all_.surfaces[s];
      const CellField& field = values_[surface.field];
      if (!is_met(surface, field.least, field.most)) continue;
      const std::size_t before = result.touched.size();
      append_touched_faces(mesh_, cell, field, surface.value, {s, {}, result.cuts.size(), 0},
                           result.touched);
      const bool touched = result.touched.size() > before;
      if (surface.value < field.most || touched) result.cuts.push_back({s, 0});
    }
  }

  // Whether no surface crosses a linear cell, as in most cells; found without the interpolant.
  [[nodiscard]] bool lies_between_surfaces(CellId cell) const {
    if (order_of(mesh_.kinds[cell]) != CellOrder::linear) return false;
    const auto nodes = mesh_.cell_nodes(cell);
    for (std::size_t f = 0; f < all_.fields.size(); ++f) {
      const FrameField& field = all_.fields[f];
      if (field.polynomial) return false;
      double least = std::numeric_limits<double>::infinity(), most = -least;
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const double value = field.values[field.index(cell, mesh_.elems[cell] + k, nodes[k])];
        least = std::min(least, value);
        most = std::max(most, value);
      }
      for (const FrameIsosurface& surface : all_.surfaces)
        if (surface.field == f && is_met(surface, least, most)) return false;
    }
    return true;
  }

  const ZooMesh& mesh_;
  const Isosurfaces& all_;
  std::vector<CellField> values_;  // of the current cell, by field
};

// Closes the faces that a surface touches from below on both sides.
void close_faces(std::vector<TouchedFace>& touched, Isosurfaces& all) {
  std::ranges::sort(touched, {}, [](const TouchedFace& f) { return f.key(); });
  for (std::size_t i = 0; i + 1 < touched.size(); ++i) {
    if (touched[i].key() != touched[i + 1].key()) continue;
    for (const std::size_t k : {i, i + 1}) close_face(touched[k], all);
  }
}

void find_cuts(const ZooMesh& mesh, Isosurfaces& all) {
  const std::size_t cells = mesh.cell_count();
  std::vector<CellCuts> parts((cells + kIsosurfacesGrain - 1) / kIsosurfacesGrain);
  parallel_for(cells, kIsosurfacesGrain, [&](IndexRange range) {
    parts[range.begin / kIsosurfacesGrain] = CutFinder(mesh, all).find(range);
  });
  all.first.reserve(cells + 1);
  all.first.push_back(0);
  std::vector<TouchedFace> touched;
  for (CellCuts& part : parts) {
    for (const std::uint32_t count : part.count) all.first.push_back(all.first.back() + count);
    for (TouchedFace& face : part.touched) {
      face.cut += all.cuts.size();
      touched.push_back(face);
    }
    all.cuts.insert(all.cuts.end(), part.cuts.begin(), part.cuts.end());
    part = {};
  }
  close_faces(touched, all);
}

// Differences from a surface's value below this may underflow in products.
constexpr double kVanishing = 0x1p-500;
// The largest exponent of a scaled field: products of two values stay finite.
constexpr int kMostExponent = 400;

// The power of two by which a field and a surface's value are multiplied: 1, unless some of the
// field's differences from the value are that small, which is possible only for a value close to 0.
double scale_for(std::span<const double> values, double value) {
  if (!(std::abs(value) < kVanishing)) return 1;
  double least = std::numeric_limits<double>::infinity(), most = std::abs(value);
  for (const double v : values) {
    const double off = std::abs(v - value);
    if (off > 0) least = std::min(least, off);
    if (std::isfinite(v)) most = std::max(most, std::abs(v));
  }
  if (!(least < kVanishing)) return 1;
  // 2^1023 is the largest power of two; fields whose values are all denormal stay smaller
  return std::ldexp(1.0, std::clamp(kMostExponent - std::ilogb(most), 0, 1023));
}

// The fields of the surfaces, each once for every scale that a surface needs.
class SurfaceFields {
 public:
  SurfaceFields(const ZooMesh& mesh, bool polynomial) : mesh_(mesh), polynomial_(polynomial) {}

  // The index of a surface's field in `all`, and the factor of the surface's value: the surface is
  // the same at every scale.
  std::pair<std::size_t, double> place_of(const Isosurface& surface, std::vector<FrameField>& all) {
    if (!given_.contains(surface.field))
      given_.emplace(surface.field, scalar_field(mesh_, surface.field));
    const Field& given = given_.at(surface.field);
    const double scale = scale_for(given.values.view(), surface.value);
    const auto [at, is_new] = places_.try_emplace({surface.field, scale}, all.size());
    if (is_new) all.push_back({{scaled(given.values, scale), given.location, polynomial_}, {}});
    return {at->second, scale};
  }

 private:
  static SharedArray<double> scaled(const SharedArray<double>& values, double scale) {
    if (scale == 1) return values;
    std::vector<double> result(values.begin(), values.end());
    for (double& v : result) v *= scale;
    return result;
  }

  const ZooMesh& mesh_;
  bool polynomial_;
  std::map<std::string, Field> given_;
  std::map<std::pair<std::string, double>, std::size_t> places_;
};

}  // namespace

Isosurfaces make_isosurfaces(const ZooMesh& mesh, const Scene& scene, const Projector& projector) {
  Isosurfaces all;
  if (scene.isosurfaces.empty()) return all;
  SurfaceFields fields(mesh, scene.render.interpolation == Interpolation::polynomial);
  for (const Isosurface& s : scene.isosurfaces) {
    const auto [field, scale] = fields.place_of(s, all.fields);
    all.surfaces.push_back({look_of(s), field, scale * s.value});
    all.largest_light =
        std::max(all.largest_light, largest_light(all.surfaces.back(), scene.lights));
  }
  all.lights = frame_lights(scene.lights, projector);
  find_cuts(mesh, all);
  return all;
}

}  // namespace hiac
