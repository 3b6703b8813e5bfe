#include "python/core/pixel.hpp"

#include <array>
#include <string>

#include <pybind11/stl.h>

namespace hiac::python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

const char* part_name(RayPart part) {
  constexpr std::array<const char*, 3> kNames{"inside", "skin", "edge"};
  return kNames[static_cast<std::size_t>(part)];
}

py::dict end_facts(const SegmentEnd& end) {
  return py::dict("depth"_a = end.depth, "color_field"_a = end.color_field,
                  "extinction_field"_a = end.extinction_field, "kappa"_a = end.kappa,
                  "tau"_a = end.tau);
}

py::object cell_of(const PixelSegment& segment) {
  if (segment.cell == kNoCell) return py::none();
  return py::int_(segment.cell);
}

// Where the ray meets the skin or an edge.
py::dict met_facts(const PixelSegment& segment) {
  return py::dict("part"_a = part_name(segment.part), "cell"_a = cell_of(segment),
                  "depth"_a = segment.front.depth, "light"_a = segment.light,
                  "opacity"_a = segment.opacity, "transparency"_a = segment.transparency,
                  "color"_a = segment.color, "in_group"_a = segment.in_group);
}

py::dict segment_facts(const PixelSegment& segment, const Scene& scene) {
  if (segment.part != RayPart::inside) return met_facts(segment);
  py::list surfaces;
  for (const MetIsosurface& met : segment.surfaces) {
    const Isosurface& surface = scene.isosurfaces[met.surface];
    surfaces.append(py::dict("field"_a = surface.field, "value"_a = surface.value,
                             "depth"_a = met.depth, "color"_a = met.color,
                             "opacity"_a = met.opacity));
  }
  return py::dict("part"_a = part_name(segment.part), "cell"_a = segment.cell,
                  "kind"_a = std::string(kind_name(segment.kind)),
                  "front"_a = end_facts(segment.front), "back"_a = end_facts(segment.back),
                  "length"_a = segment.length, "psi"_a = segment.psi, "isosurfaces"_a = surfaces,
                  "transparency"_a = segment.transparency, "color"_a = segment.color,
                  "error"_a = segment.error, "in_group"_a = segment.in_group,
                  "out_of_order"_a = segment.out_of_order);
}

}  // namespace

py::dict pixel_facts(const PixelExplanation& pixel, const Scene& scene) {
  py::list segments;
  for (const PixelSegment& segment : pixel.segments) segments.append(segment_facts(segment, scene));
  const Volume& volume = scene.volume;
  py::dict fields("color"_a = py::none(), "extinction"_a = py::none());
  if (volume.color) fields["color"] = volume.color->field;
  if (volume.extinction) fields["extinction"] = volume.extinction->field;
  const auto& rgba = pixel.rgba;
  return py::dict("x"_a = pixel.x, "y"_a = pixel.y, "fields"_a = fields, "segments"_a = segments,
                  "ended"_a = pixel.ended, "transparency"_a = pixel.transparency,
                  "background"_a = pixel.background,
                  "color"_a = std::array<double, 3>{rgba[0], rgba[1], rgba[2]}, "alpha"_a = rgba[3],
                  "error"_a = pixel.error);
}

}  // namespace hiac::python
