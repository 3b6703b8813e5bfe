#include "hiac/element/cell_surface.hpp"

#include <algorithm>

namespace hiac {
namespace {

using Corner = std::uint8_t;

class SurfaceBuilder {
 public:
  SurfaceBuilder(CellKind kind, std::span<const NodeId> nodes) {
    const std::size_t count = corner_count(kind);
    std::array<std::uint64_t, CellSurface::kMostCorners> key;
    for (std::size_t k = 0; k < count; ++k) key[k] = (std::uint64_t{nodes[k]} << 3) | k;
    std::sort(key.begin(), key.begin() + count);
    surface_.corner_count = count;
    for (std::size_t k = 0; k < count; ++k) {
      surface_.nodes[k] = static_cast<NodeId>(key[k] >> 3);
      surface_.ranks[key[k] & 7] = static_cast<Corner>(k);
    }
    for (auto& row : edge_) row.fill(kNoEdge);
  }

  void add_face(const ShapeFace& face, std::size_t number) {
    face_ = static_cast<Corner>(number);
    std::array<Corner, 4> c{};
    for (std::size_t k = 0; k < face.corner_count; ++k) c[k] = surface_.ranks[face.corners[k]];
    if (face.corner_count == 3) return add_triangle({c[0], c[1], c[2]});
    std::size_t s = 0;
    for (std::size_t k = 1; k < 4; ++k)
      if (c[k] < c[s]) s = k;
    const auto from_smallest = [&](std::size_t k) { return c[(s + k) % 4]; };
    add_triangle({from_smallest(0), from_smallest(1), from_smallest(2)});
    add_triangle({from_smallest(0), from_smallest(2), from_smallest(3)});
  }

  [[nodiscard]] const CellSurface& surface() const { return surface_; }

 private:
  static constexpr Corner kNoEdge = 255;

  void add_triangle(std::array<Corner, 3> c) {
    std::sort(c.begin(), c.end());
    surface_.triangles[surface_.triangle_count++] = {
        c, {edge_between(c[0], c[1]), edge_between(c[0], c[2]), edge_between(c[1], c[2])}, face_};
  }

  Corner edge_between(Corner low, Corner high) {
    Corner& edge = edge_[low][high];
    if (edge == kNoEdge) {
      edge = static_cast<Corner>(surface_.edge_count);
      surface_.edges[surface_.edge_count++] = {low, high};
    }
    return edge;
  }

  CellSurface surface_;
  Corner face_ = 0;  // current
  std::array<std::array<Corner, CellSurface::kMostCorners>, CellSurface::kMostCorners> edge_;
};

}  // namespace

CellSurface cell_surface(CellKind kind, std::span<const NodeId> nodes) {
  SurfaceBuilder builder(kind, nodes);
  const auto faces = topology_of(kind).faces;
  for (std::size_t f = 0; f < faces.size(); ++f) builder.add_face(faces[f], f);
  return builder.surface();
}

}  // namespace hiac
