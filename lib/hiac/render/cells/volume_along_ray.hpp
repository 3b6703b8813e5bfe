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
  /// The frame must outlive it.
  VolumeAlongRay(const Frame& frame, const TileRect& tile);

  /// Takes a cell of the frame's mesh.
  void enter(CellId cell);

  [[nodiscard]] const CellScalars& extinction() const { return extinction_; }
  [[nodiscard]] const CellScalars& color() const { return color_; }
  /// The extinction's field and, where it is another one, the colour's.
  [[nodiscard]] std::span<const CellField> fields() const { return {fields_.data(), count_}; }
  /// The cell neither absorbs nor shines.
  [[nodiscard]] bool is_empty() const;
  /// Colour and extinction each have one value in the whole cell.
  [[nodiscard]] bool is_uniform() const { return is_uniform_; }
  /// The longest ray through the mesh that the tile may hold, world units.
  [[nodiscard]] double longest() const { return longest_; }
  /// Of a segment that is seen through `visible`, as a part of the tolerance in proportion to its
  /// length.
  [[nodiscard]] double allowed_error(double front, double back, double visible) const {
    return shares_.integration * frame_.tolerance * ((back - front) / frame_.depth) / visible;
  }

  /// What a stretch does to the light. `scale`: world length per unit of the ray parameter;
  /// `field`: fields() along rays; `visible`: the transparency in front.
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
