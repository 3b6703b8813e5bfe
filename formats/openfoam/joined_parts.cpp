#include "formats/openfoam/joined_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "formats/openfoam/foam_file.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::openfoam {
namespace {

constexpr std::size_t kNowhere = ~std::size_t{0};

/// Copies of one point differ by at most this fraction of the largest coordinate: parts may be
/// written with few digits.
constexpr double kSamePlace = 1e-5;

double largest_coordinate(const std::vector<CasePart>& parts) {
  double largest = 0;
  for (const CasePart& part : parts)
    for (const double x : part.xyz) largest = std::max(largest, std::abs(x));
  return largest;
}

bool same_place(const double* a, const double* b, double slack) {
  for (std::size_t c = 0; c < 3; ++c)
    if (!(std::abs(a[c] - b[c]) <= slack)) return false;
  return true;
}

/// The entries of an addressing file; none when there is no such file or its entries do not fit.
std::optional<std::vector<std::size_t>> addresses(const CasePart& part, const std::string& name,
                                                  std::size_t count, std::size_t most) {
  const std::string path = part.mesh_file(name);
  if (!FoamFile::exists(path)) return std::nullopt;
  const std::vector<std::int64_t> labels = FoamFile(path).labels(count);
  if (labels.size() != count) return std::nullopt;
  std::vector<std::size_t> result;
  result.reserve(count);
  for (const std::int64_t label : labels) {
    if (label < 0 || static_cast<std::uint64_t>(label) >= most) return std::nullopt;
    result.push_back(static_cast<std::size_t>(label));
  }
  return result;
}

/// Joins the parts by their addressing files; none when these are missing or contradict each other.
std::optional<JoinedParts> join_by_addresses(const std::vector<CasePart>& parts) {
  std::size_t points = 0;
  std::size_t cells = 0;
  for (const CasePart& part : parts) {
    points += part.point_count();
    cells += part.faces_of.size();
  }
  JoinedParts joined;
  joined.cells.assign(cells, {kNowhere, 0});
  std::vector<const double*> places(points, nullptr);
  const double slack = kSamePlace * largest_coordinate(parts);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const CasePart& part = parts[p];
    auto of_points = addresses(part, "pointProcAddressing", part.point_count(), points);
    const auto of_cells = addresses(part, "cellProcAddressing", part.faces_of.size(), cells);
    if (!of_points || !of_cells) return std::nullopt;
    for (std::size_t i = 0; i < of_points->size(); ++i) {
      const std::size_t place = (*of_points)[i];
      if (places[place] != nullptr && !same_place(places[place], &part.xyz[3 * i], slack))
        return std::nullopt;
      places[place] = &part.xyz[3 * i];
      joined.points = std::max(joined.points, place + 1);
    }
    for (std::size_t cell = 0; cell < of_cells->size(); ++cell) {
      auto& whole = joined.cells[(*of_cells)[cell]];
      if (whole.first != kNowhere) return std::nullopt;
      whole = {p, cell};
    }
    joined.point_places.push_back(std::move(*of_points));
  }
  const auto known = places.begin() + static_cast<long>(joined.points);
  if (std::find(places.begin(), known, nullptr) != known) return std::nullopt;
  joined.notes.emplace_back("joined the parts by pointProcAddressing and cellProcAddressing");
  return joined;
}

/// Points of all parts, one after the other, of which some are merged.
class UnitedPoints {
 public:
  explicit UnitedPoints(std::size_t count) : above_(count) {
    std::iota(above_.begin(), above_.end(), std::size_t{0});
  }
  std::size_t first_of(std::size_t point) {
    while (above_[point] != point) point = above_[point] = above_[above_[point]];
    return point;
  }
  void unite(std::size_t a, std::size_t b) {
    a = first_of(a);
    b = first_of(b);
    above_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> above_;
};

class PatchJoiner {
 public:
  explicit PatchJoiner(const std::vector<CasePart>& parts)
      : parts_(parts), slack_(kSamePlace * largest_coordinate(parts)) {
    std::size_t points = 0;
    for (const CasePart& part : parts) {
      first_point_.push_back(points);
      points += part.point_count();
      const std::string path = part.mesh_file("boundary");
      patches_.push_back(FoamFile(path).patches());
      std::erase_if(patches_.back(), [](const Patch& patch) {
        return patch.type != "processor" || patch.faces == 0;
      });
      for (const Patch& patch : patches_.back()) check(patch, patches_.size() - 1, path);
    }
    first_point_.push_back(points);
  }

  JoinedParts run() {
    UnitedPoints united(first_point_.back());
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (const Patch& patch : patches_[p]) {
        const Patch& other = other_side(p, patch);  // refuses a patch that has none
        if (static_cast<std::size_t>(patch.neighbour) > p) join(p, patch, other, united);
      }
    JoinedParts joined;
    std::vector<std::size_t> places(first_point_.back(), kNowhere);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      std::vector<std::size_t>& of_part = joined.point_places.emplace_back();
      for (std::size_t i = first_point_[p]; i < first_point_[p + 1]; ++i) {
        std::size_t& place = places[united.first_of(i)];
        if (place == kNowhere) place = joined.points++;
        of_part.push_back(place);
      }
      for (std::size_t cell = 0; cell < parts_[p].faces_of.size(); ++cell)
        joined.cells.emplace_back(p, cell);
    }
    return joined;
  }

 private:
  void check(const Patch& patch, std::size_t p, const std::string& path) const {
    const std::size_t faces = parts_[p].starts.size() - 1;
    if (patch.faces < 0 || patch.start_face < 0 ||
        static_cast<std::uint64_t>(patch.start_face) > faces ||
        static_cast<std::uint64_t>(patch.faces) >
            faces - static_cast<std::size_t>(patch.start_face))
      throw InputError(path, fmt::format("a patch of {} faces from face {} on ({} faces found)",
                                         patch.faces, patch.start_face, faces));
    if (patch.neighbour < 0 || static_cast<std::uint64_t>(patch.neighbour) >= parts_.size())
      throw InputError(path,
                       fmt::format("a patch to part {}, which there is not (0 to {} expected)",
                                   patch.neighbour, parts_.size() - 1));
    if (static_cast<std::size_t>(patch.neighbour) == p)
      throw InputError(path, fmt::format("a patch of part {} to itself", p));
  }

  const Patch& other_side(std::size_t p, const Patch& patch) const {
    const auto q = static_cast<std::size_t>(patch.neighbour);
    for (const Patch& other : patches_[q])
      if (other.neighbour == static_cast<std::int64_t>(p) && other.faces == patch.faces)
        return other;
    throw InputError(parts_[q].mesh_file("boundary"),
                     fmt::format("no patch of {} faces to part {}, as part {} has one to it",
                                 patch.faces, p, p));
  }

  /// The two copies of a face turn in opposite senses and begin with the same point.
  void join(std::size_t p, const Patch& patch, const Patch& other, UnitedPoints& united) const {
    const auto q = static_cast<std::size_t>(patch.neighbour);
    const CasePart& a = parts_[p];
    const CasePart& b = parts_[q];
    for (std::int64_t f = 0; f < patch.faces; ++f) {
      const auto face = static_cast<std::size_t>(patch.start_face + f);
      const auto twin = static_cast<std::size_t>(other.start_face + f);
      const std::size_t corners = a.starts[face + 1] - a.starts[face];
      const bool alike = b.starts[twin + 1] - b.starts[twin] == corners;
      for (std::size_t i = 0; i < corners && alike; ++i) {
        const std::size_t one = point(a, a.starts[face] + i);
        const std::size_t same = point(b, b.starts[twin] + (corners - i) % corners);
        if (!same_place(&a.xyz[3 * one], &b.xyz[3 * same], slack_)) return refuse(q, face, p);
        united.unite(first_point_[p] + one, first_point_[q] + same);
      }
      if (!alike) return refuse(q, face, p);
    }
  }

  [[noreturn]] void refuse(std::size_t q, std::size_t face, std::size_t p) const {
    throw InputError(
        parts_[q].mesh_file("boundary"),
        fmt::format("its patch to part {} does not meet that part's face {}", p, face));
  }

  static std::size_t point(const CasePart& part, std::size_t entry) {
    const std::int64_t node = part.nodes[entry];
    if (node < 0 || static_cast<std::uint64_t>(node) >= part.point_count())
      throw InputError(
          part.mesh_file("faces"),
          fmt::format("there is no point {} ({} points found)", node, part.point_count()));
    return static_cast<std::size_t>(node);
  }

  const std::vector<CasePart>& parts_;
  double slack_;
  std::vector<std::size_t> first_point_;  ///< among the points of all parts
  std::vector<std::vector<Patch>> patches_;
};

}  // namespace

JoinedParts join_parts(const std::vector<CasePart>& parts) {
  if (auto joined = join_by_addresses(parts)) return std::move(*joined);
  JoinedParts joined = PatchJoiner(parts).run();
  joined.notes.push_back(
      "joined the parts by their patches: addressing files that fit together are not there");
  return joined;
}

}  // namespace hiac::formats::openfoam
