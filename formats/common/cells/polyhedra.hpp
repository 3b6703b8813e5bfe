#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

using FaceNodes = std::vector<std::int64_t>;

/// The faces of the polyhedron at that place in the list. Throws InputError(subject, ...) when the
/// list is damaged.
std::vector<FaceNodes> faces_of(const ForeignPolyhedra& polyhedra, std::size_t place,
                                const std::string& subject);

/// The faces of a closed polyhedron, all reoriented to be counter-clockwise seen from outside;
/// `position(node)` is a node's position. Nothing when the faces do not close.
std::optional<std::vector<FaceNodes>> turned_outward(
    std::vector<FaceNodes> faces,
    const std::function<std::span<const double>(std::int64_t node)>& position);

}  // namespace hiac::formats
