#pragma once

#include <array>
#include <span>
#include <vector>

#include "hiac/element/field_along_ray.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/tile.hpp"
#include "hiac/frame/tolerance_shares.hpp"
#include "hiac/optics/piece_rule.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/cells/cell_scalars.hpp"

namespace hiac {

/// The volume of one cell of any kind, integrated along one ray at a time.
class VolumeAlongRay {
 public:
  /// The frame must outlive this object.
  VolumeAlongRay(const Frame& frame, const TileRect& tile);

  /// Selects a cell of the frame's mesh.
  void enter(CellId cell);

  [[nodiscard]] const CellScalars& extinction() const { return extinction_; }
  [[nodiscard]] const CellScalars& color() const { return color_; }
  /// The extinction's field and, if it differs, the colour's.
  [[nodiscard]] std::span<const CellField> fields() const { return {fields_.data(), count_}; }
  /// Whether the cell neither absorbs nor emits light.
  [[nodiscard]] bool is_empty() const;
  /// Whether colour and extinction each have one value in the whole cell.
  [[nodiscard]] bool is_uniform() const { return is_uniform_; }
  /// A bound of the length of any ray of the tile through the mesh, world units.
  [[nodiscard]] double longest() const { return longest_; }
  /// The integration error allowed for a segment behind the transparency `visible`: a part of the
  /// tolerance in proportion to the segment's length.
  [[nodiscard]] double allowed_error(double front, double back, double visible) const {
    return shares_.integration * frame_.tolerance * ((back - front) / frame_.depth) / visible;
  }

  /// The radiance and transparency of a stretch. `scale`: world length per unit of the ray
  /// parameter; `field`: fields() along rays; `visible`: the transparency in front.
  [[nodiscard]] PlainRadiance radiance(const RayStretch& stretch, double scale,
                                       const FieldAlongRay& field, double visible);
  /// The bound of the last radiance's quadrature.
  [[nodiscard]] const ErrorBound& quadrature() const { return quadrature_; }

 private:
  [[nodiscard]] PlainRadiance uniform(double length) const;
  [[nodiscard]] PlainRadiance integrated(const RayStretch& stretch, double length,
                                         const FieldAlongRay& field, double visible);
  [[nodiscard]] PlainRadiance unsliced(double length) const;

  const Frame& frame_;
  const OpticsTables& optics_;
  Glow glow_;
  double longest_;
  CellScalars extinction_{}, color_{};
  std::array<CellField, 2> fields_{};
  std::size_t count_;
  ToleranceShares shares_{};
  bool is_uniform_ = false;
  std::vector<FieldAlongRay::Piece> pieces_;
  ErrorBound quadrature_;
};

}  // namespace hiac
