#include "formats/common/cells/reduce_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/common/cells/face_cells.hpp"
#include "formats/common/cells/polyhedra.hpp"
#include "formats/common/cells/recognized_cells.hpp"
#include "formats/common/mesh/mesh_rewrite.hpp"

namespace hiac::formats {
namespace {

/// The number of cells used to recognize a type.
constexpr std::size_t kSamples = 64;
/// Values that differ by less than this, relative to the largest value, are the same.
constexpr double kSameDouble = 1e-12;
constexpr double kSameSingle = 1e-6;

/// Values at all points: the coordinates, or a field.
struct PointValues {
  std::string name;
  std::size_t width;
  std::vector<double> values;
  double same = 0;  ///< values that differ by less are the same
  double low = 0;
  double high = 0;
};

PointValues point_values(std::string name, std::size_t width, std::vector<double>&& values) {
  PointValues result{std::move(name), width, std::move(values)};
  bool single = true;
  double largest = 0;
  result.low = HUGE_VAL;
  result.high = -HUGE_VAL;
  for (const double value : result.values) {
    if (!std::isfinite(value)) continue;
    single = single && static_cast<double>(static_cast<float>(value)) == value;
    largest = std::max(largest, std::abs(value));
    result.low = std::min(result.low, value);
    result.high = std::max(result.high, value);
  }
  result.same = largest * (single ? kSameSingle : kSameDouble);
  return result;
}

/// The findings for a cell type that the zoo does not have.
struct RichType {
  std::optional<RecognizedCell> cell;
  std::size_t count = 0;
  std::vector<double> errors;  ///< the largest, for the coordinates and every field
  bool turned = false;
};

class Reducer {
 public:
  Reducer(ForeignMesh& mesh, const ReadOptions& options,
          std::span<const ForeignField* const> fields, const std::string& subject)
      : mesh_(mesh), options_(options), subject_(subject), rewrite_(mesh, subject) {
    values_.push_back(point_values("", 3, std::vector<double>(mesh.xyz)));
    for (const ForeignField* field : fields) {
      if (field->location != FieldLocation::node) continue;
      std::vector<double> values = field->values();
      if (values.size() == mesh.point_count() * field->components)
        values_.push_back(point_values(field->name, field->components, std::move(values)));
    }
  }

  std::string run() {
    find_rich_types();
    if (rich_.empty() && mesh_.polyhedra.cells.empty()) return {};
    for (std::size_t cell = 0; cell < mesh_.cell_count(); ++cell) measure(cell);
    judge();
    std::size_t polyhedron = 0;
    const std::size_t cells = mesh_.cell_count();
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const auto rich = rich_.find(mesh_.cell_types[cell]);
      if (polyhedron < mesh_.polyhedra.cells.size() && mesh_.polyhedra.cells[polyhedron] == cell)
        turn_polyhedron(cell, polyhedron++);
      else if (rich != rich_.end() && rich->second.turned)
        turn_rich(cell, *rich->second.cell);
      else
        rewrite_.keep();
    }
    rewrite_.finish();
    note_polyhedra();
    return fmt::format("{}", fmt::join(reasons_, "; "));
  }

 private:
  /// The places of the cell's nodes among the points; empty when the cell leaves nodes out.
  std::vector<std::size_t> places_of(std::size_t cell) const {
    std::vector<std::size_t> places;
    for (const std::int64_t number : rewrite_.nodes_of(cell)) {
      if (number == kLeftOutNode) return {};
      places.push_back(rewrite_.place_of(number, cell));
    }
    return places;
  }

  void find_rich_types() {
    if (options_.corners_of_unsupported) return;
    std::map<std::uint16_t, std::vector<NodePositions>> samples;
    std::map<std::uint16_t, bool> complete;
    for (std::size_t cell = 0; cell < mesh_.cell_count(); ++cell) {
      const std::uint16_t type = mesh_.cell_types[cell];
      const CellConversion& conversion = mesh_.types[type].conversion;
      if (conversion.fate != CellFate::unsupported || !conversion.corners) continue;
      const std::vector<std::size_t> places = places_of(cell);
      complete.try_emplace(type, true).first->second &= !places.empty();
      ++rich_[type].count;
      const std::set<std::size_t> distinct(places.begin(), places.end());
      if (samples[type].size() >= kSamples || distinct.size() != mesh_.types[type].nodes) continue;
      NodePositions positions;
      for (const std::size_t place : places)
        positions.push_back(
            {mesh_.xyz[3 * place], mesh_.xyz[3 * place + 1], mesh_.xyz[3 * place + 2]});
      samples[type].push_back(std::move(positions));
    }
    for (auto& [type, rich] : rich_) {
      const ForeignType& foreign = mesh_.types[type];
      if (!foreign.places.empty()) samples[type] = {foreign.places};
      if (complete[type]) rich.cell = recognized_cell(foreign.conversion, samples[type]);
      rich.errors.resize(values_.size(), 0.0);
    }
  }

  /// Measures how far the interpolant of the nearest kind is from the file's values at the nodes
  /// left out.
  void measure(std::size_t cell) {
    const auto found = rich_.find(mesh_.cell_types[cell]);
    if (found == rich_.end() || !found->second.cell) return;
    const RecognizedCell& kind = *found->second.cell;
    const std::vector<std::size_t> places = places_of(cell);
    std::vector<double> nodes(kind.weights.size());
    for (std::size_t v = 0; v < values_.size(); ++v) {
      const std::size_t width = values_[v].width;
      for (std::size_t c = 0; c < width; ++c) {
        const auto value = [&](std::size_t place) {
          return values_[v].values[places[place] * width + c];
        };
        for (std::size_t n = 0; n < nodes.size(); ++n) {
          nodes[n] = 0;
          for (const auto& [place, weight] : kind.weights[n]) nodes[n] += weight * value(place);
        }
        for (const auto& left_out : kind.left_out) {
          double sum = 0;
          for (std::size_t n = 0; n < nodes.size(); ++n)
            sum += left_out.shape_functions[n] * nodes[n];
          const double error = std::abs(sum - value(left_out.place));
          // NaN in both is no error, NaN in one of them is
          if (error > found->second.errors[v] ||
              (std::isnan(sum) != std::isnan(value(left_out.place))))
            found->second.errors[v] = std::isnan(error) ? HUGE_VAL : error;
        }
      }
    }
  }

  /// Decides which types are converted, and writes the notes about them.
  void judge() {
    for (auto& [type, rich] : rich_) {
      const std::string what = fmt::format("{} {} of {} nodes", rich.count, mesh_.types[type].name,
                                           mesh_.types[type].nodes);
      if (!rich.cell) {
        reasons_.push_back(
            fmt::format("the nodes of {} lie where those of no known kind do", what));
        continue;
      }
      bool exact = true;
      for (std::size_t v = 0; v < values_.size(); ++v) exact &= rich.errors[v] <= values_[v].same;
      const bool high = rich.cell->order > 3;
      rich.turned = options_.approximate || (exact && !high);
      if (!rich.turned) {
        reasons_.push_back(
            high ? fmt::format("{} are of order {} (ReadOptions::approximate makes them cubic: {})",
                               what, rich.cell->order, errors_of(rich))
                 : fmt::format("{} need their nodes in faces or inside (ReadOptions::approximate "
                               "makes them {}: "
                               "{})",
                               what, kind_name(rich.cell->kind), errors_of(rich)));
        continue;
      }
      mesh_.notes.push_back(
          exact ? fmt::format("{} became {}, which loses nothing: the nodes left out, and the "
                              "fields there, are what the others make of them",
                              what, kind_name(rich.cell->kind))
                : fmt::format("approximated {} by {}: {}", what, kind_name(rich.cell->kind),
                              errors_of(rich)));
    }
  }

  /// The errors at the file's nodes.
  [[nodiscard]] std::string errors_of(const RichType& rich) const {
    std::string text = fmt::format("nodes move by up to {:.3g}", rich.errors[0]);
    for (std::size_t v = 1; v < values_.size(); ++v)
      text += fmt::format(", field '{}' errs by up to {:.3g} at nodes (range {:.3g} to {:.3g})",
                          values_[v].name, rich.errors[v], values_[v].low, values_[v].high);
    return text;
  }

  void turn_rich(std::size_t cell, const RecognizedCell& kind) {
    const auto numbers = rewrite_.nodes_of(cell);
    const std::vector<std::size_t> places = places_of(cell);
    const ForeignType type = mesh_.types[mesh_.cell_types[cell]];
    const std::uint16_t place =
        mesh_.type_place(type.name + ", reduced", kind.weights.size(), converted_to(kind.kind));
    rewrite_.replace();
    std::vector<std::int64_t> nodes;
    for (std::size_t n = 0; n < kind.weights.size(); ++n) {
      const Weights& weights = kind.weights[n];
      if (weights.size() == 1) {
        nodes.push_back(numbers[weights.front().first]);
        continue;
      }
      Weights points;
      std::size_t anchor = 0;
      double heaviest = 0;
      for (const auto& [node, weight] : weights) {
        points.emplace_back(places[node], weight);
        // the two nodes on the thirds of an edge have their heaviest weights at different nodes
        if (std::abs(weight) > heaviest * (1 + kSameDouble)) {
          heaviest = std::abs(weight);
          anchor = places[node] + 1;
        }
      }
      if (n >= corner_count(kind.kind) + 2 * edge_count(kind.kind)) anchor = 0;
      nodes.push_back(rewrite_.point(std::move(points), anchor));
    }
    rewrite_.add(place, nodes, kind.weights);
  }

  void turn_polyhedron(std::size_t cell, std::size_t polyhedron) {
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
    divide(cell, *faces);
  }

  void leave_polyhedron(const std::string& reason) {
    const std::string text = "polyhedra " + reason;
    if (std::find(reasons_.begin(), reasons_.end(), text) == reasons_.end())
      reasons_.push_back(text);
    rewrite_.keep();
  }

  /// The point at the mean of nodes; cells with the same nodes share it.
  std::int64_t centre_of(std::span<const std::int64_t> numbers, std::size_t cell) {
    std::set<std::size_t> places;
    for (const std::int64_t number : numbers) places.insert(rewrite_.place_of(number, cell));
    Weights weights;
    for (const std::size_t place : places)
      weights.emplace_back(place, 1.0 / static_cast<double>(places.size()));
    for (PointValues& values : values_) widen(values, weights);
    return rewrite_.point(std::move(weights), 0);
  }

  /// Records the range of values over the nodes that a centre is the mean of.
  void widen(const PointValues& values, const Weights& weights) {
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

  void divide(std::size_t cell, const std::vector<FaceNodes>& faces) {
    FaceNodes all;
    for (const FaceNodes& face : faces) all.insert(all.end(), face.begin(), face.end());
    const std::int64_t centre = centre_of(all, cell);
    const std::uint16_t tetrahedron =
        mesh_.type_place("part of a polyhedron", 4, converted_to(CellKind::tetrahedron4));
    const std::uint16_t pyramid =
        mesh_.type_place("part of a polyhedron", 5, converted_to(CellKind::pyramid5));
    rewrite_.replace();
    ++divided_;
    // the zoo's bases turn counter-clockwise seen from the apex, opposite to these faces
    for (const FaceNodes& face : faces) {
      if (face.size() == 3) {
        rewrite_.add(tetrahedron, std::array{face[0], face[2], face[1], centre}, {});
      } else if (face.size() == 4) {
        rewrite_.add(pyramid, std::array{face[0], face[3], face[2], face[1], centre}, {});
      } else {
        const std::int64_t middle = centre_of(face, cell);
        for (std::size_t i = 0; i < face.size(); ++i)
          rewrite_.add(tetrahedron,
                       std::array{face[(i + 1) % face.size()], face[i], middle, centre}, {});
      }
    }
  }

  void note_polyhedra() {
    if (recognized_ > 0)
      mesh_.notes.push_back(
          fmt::format("{} polyhedra have the faces of kinds and became these", recognized_));
    if (divided_ == 0) return;
    std::string text = fmt::format(
        "divided {} polyhedra into tetrahedra and pyramids round their centres, with "
        "the mean of the nodes there",
        divided_);
    for (const auto& [name, range] : ranges_)
      if (!name.empty())
        text += fmt::format(
            "; field '{}' differs by up to {:.3g} over the nodes of one, which "
            "bounds the error inside",
            name, range);
    mesh_.notes.push_back(std::move(text));
  }

  ForeignMesh& mesh_;
  const ReadOptions& options_;
  const std::string& subject_;
  MeshRewrite rewrite_;
  std::vector<PointValues> values_;  ///< the coordinates first
  std::map<std::uint16_t, RichType> rich_;
  std::vector<std::string> reasons_;
  std::size_t recognized_ = 0;
  std::size_t divided_ = 0;
  std::map<std::string, double> ranges_;
};

}  // namespace

std::string reduce_cells(ForeignMesh& mesh, const ReadOptions& options,
                         std::span<const ForeignField* const> fields, const std::string& subject) {
  const bool any_rich =
      std::any_of(mesh.types.begin(), mesh.types.end(), [](const ForeignType& type) {
        return type.conversion.fate == CellFate::unsupported && type.conversion.corners;
      });
  if (mesh.polyhedra.cells.empty() && (!any_rich || options.corners_of_unsupported)) return {};
  return Reducer(mesh, options, fields, subject).run();
}

}  // namespace hiac::formats
