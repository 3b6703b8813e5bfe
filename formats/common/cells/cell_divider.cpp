#include "formats/common/cells/cell_divider.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "formats/common/cells/face_cells.hpp"
#include "hiac/mesh/metadata_keys.hpp"

namespace hiac::formats {

void CellDivider::turn_polyhedron(std::size_t cell, std::size_t polyhedron) {
  const auto position = [&](std::int64_t number) {
    return std::span<const double>(mesh_.xyz).subspan(3 * rewrite_.place_of(number, cell), 3);
  };
  const auto faces = turned_outward(faces_of(mesh_.polyhedra, polyhedron, subject_), position);
  if (!faces) return leave_polyhedron("have faces that do not close round them");
  if (const auto known = cell_of_faces(*faces)) {
    ++recognized_;
    rewrite_.replace();
    return rewrite_.add(
        mesh_.type_place(fmt::format("polyhedron, a {}", topology_of(known->kind).name),
                         known->nodes.size(), converted_to(known->kind)),
        known->nodes, {});
  }
  if (!options_.approximate)
    return leave_polyhedron(
        "have faces that no kind has (ReadOptions::approximate divides them into tetrahedra and "
        "pyramids)");
  ++divided_;
  divide(cell, *faces);
}

bool CellDivider::divide_collapsed(std::size_t cell) {
  const CellConversion& conversion = mesh_.types[mesh_.cell_types[cell]].conversion;
  if (conversion.fate != CellFate::converted) return false;
  const CellKind kind = kind_of(shape_of(conversion.kind), CellOrder::linear);
  const auto numbers = rewrite_.nodes_of(cell);
  std::vector<std::int64_t> corners;
  std::vector<NodeId> places;
  for (std::size_t n = 0; n < corner_count(kind); ++n) {
    corners.push_back(numbers[conversion.permutation.empty() ? n : conversion.permutation[n]]);
    if (corners.back() == kLeftOutNode) return false;
    places.push_back(static_cast<NodeId>(rewrite_.place_of(corners.back(), cell)));
  }
  if (!TrueKinds::has_repeated_corner(kind, places)) return false;
  if (true_kinds_.find(kind, places).problem.empty()) return false;
  std::vector<FaceNodes> faces;
  for (const auto& face : merged_faces(kind, places)) {
    faces.emplace_back();
    for (const std::uint8_t corner : face) faces.back().push_back(corners[corner]);
  }
  if (faces.size() < 4) {
    ++flat_;
    rewrite_.replace();
    return true;
  }
  ++collapsed_;
  divide(cell, faces);
  return true;
}

void CellDivider::leave_polyhedron(const std::string& reason) {
  const std::string text = "polyhedra " + reason;
  if (std::find(reasons_.begin(), reasons_.end(), text) == reasons_.end()) reasons_.push_back(text);
  rewrite_.keep();
}

std::int64_t CellDivider::centre_of(std::span<const std::int64_t> numbers, std::size_t cell) {
  std::set<std::size_t> places;
  for (const std::int64_t number : numbers) places.insert(rewrite_.place_of(number, cell));
  Weights weights;
  for (const std::size_t place : places)
    weights.emplace_back(place, 1.0 / static_cast<double>(places.size()));
  for (const PointValues& values : values_) widen(values, weights);
  return rewrite_.point(std::move(weights), 0);
}

void CellDivider::widen(const PointValues& values, const Weights& weights) {
  double& range = ranges_[values.name];
  for (std::size_t c = 0; c < values.width; ++c) {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (const auto& [place, weight] : weights) {
      low = std::min(low, values.values[place * values.width + c]);
      high = std::max(high, values.values[place * values.width + c]);
    }
    if (high > low) range = std::max(range, high - low);
  }
}

void CellDivider::divide(std::size_t cell, const std::vector<FaceNodes>& faces) {
  FaceNodes all;
  for (const FaceNodes& face : faces) all.insert(all.end(), face.begin(), face.end());
  const std::int64_t centre = centre_of(all, cell);
  const std::uint16_t tetrahedron =
      mesh_.type_place("part of a cell", 4, converted_to(CellKind::tetrahedron4));
  const std::uint16_t pyramid =
      mesh_.type_place("part of a cell", 5, converted_to(CellKind::pyramid5));
  rewrite_.replace();
  // the zoo's bases turn counter-clockwise seen from the apex, opposite to these faces
  for (const FaceNodes& face : faces) {
    if (face.size() == 3) {
      rewrite_.add(tetrahedron, std::array{face[0], face[2], face[1], centre}, {});
    } else if (face.size() == 4) {
      rewrite_.add(pyramid, std::array{face[0], face[3], face[2], face[1], centre}, {});
    } else {
      const std::int64_t middle = centre_of(face, cell);
      for (std::size_t i = 0; i < face.size(); ++i)
        rewrite_.add(tetrahedron, std::array{face[(i + 1) % face.size()], face[i], middle, centre},
                     {});
    }
  }
}

void CellDivider::note_divided(std::size_t count, std::string_view what) {
  if (count == 0) return;
  std::string text = fmt::format(
      "divided {} {} into tetrahedra and pyramids round their centres, with the mean of the "
      "nodes there",
      count, what);
  for (const auto& [name, range] : ranges_)
    if (!name.empty())
      text += fmt::format(
          "; field '{}' differs by up to {:.3g} over the nodes of one, which "
          "bounds the error inside",
          name, range);
  mesh_.metadata.emplace_back(kApproximated, text);
  mesh_.notes.push_back(std::move(text));
}

void CellDivider::add_notes() {
  if (recognized_ > 0)
    mesh_.notes.push_back(
        fmt::format("{} polyhedra have the faces of kinds and became these", recognized_));
  note_divided(divided_, "polyhedra");
  note_divided(collapsed_, "cells with repeated nodes that are of no kind");
  if (flat_ > 0)
    mesh_.notes.push_back(
        fmt::format("left out {} cells whose repeated nodes leave no volume", flat_));
}

}  // namespace hiac::formats
