#include "formats/common/cells/reduce_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/common/cells/cell_divider.hpp"
#include "formats/common/cells/point_values.hpp"
#include "formats/common/cells/recognized_cells.hpp"
#include "formats/common/mesh/mesh_rewrite.hpp"
#include "hiac/mesh/metadata_keys.hpp"

namespace hiac::formats {
namespace {

/// The number of cells used to recognize a type.
constexpr std::size_t kSamples = 64;
/// The findings for a cell type that the zoo does not have.
struct RichType {
  std::optional<RecognizedCell> cell;
  std::size_t count = 0;
  std::vector<double> errors;  ///< the largest, for the coordinates and every field
  /// How far rounding by one unit at most takes the interpolant from a node left out.
  double rounding = 0;
  bool turned = false;
};

/// Whether a cell of a kind of the zoo names one of its nodes twice.
bool has_repeated_nodes(const ForeignMesh& mesh) {
  std::size_t begin = 0;
  for (const std::uint16_t number : mesh.cell_types) {
    const ForeignType& type = mesh.types[number];
    const auto nodes = std::span(mesh.cell_nodes).subspan(begin, type.nodes);
    begin += type.nodes;
    if (type.conversion.fate != CellFate::converted) continue;
    for (std::size_t i = 1; i < nodes.size(); ++i)
      if (std::find(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(i), nodes[i]) !=
          nodes.begin() + static_cast<std::ptrdiff_t>(i))
        return true;
  }
  return false;
}

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
    if (rich_.empty() && mesh_.polyhedra.cells.empty() && !options_.approximate) return {};
    for (std::size_t cell = 0; cell < mesh_.cell_count(); ++cell) measure(cell);
    judge();
    std::size_t polyhedron = 0;
    const std::size_t cells = mesh_.cell_count();
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const auto rich = rich_.find(mesh_.cell_types[cell]);
      if (polyhedron < mesh_.polyhedra.cells.size() && mesh_.polyhedra.cells[polyhedron] == cell)
        divider_.turn_polyhedron(cell, polyhedron++);
      else if (rich != rich_.end() && rich->second.turned)
        turn_rich(cell, *rich->second.cell);
      else if (!options_.approximate || !divider_.divide_collapsed(cell))
        rewrite_.keep();
    }
    rewrite_.finish();
    divider_.add_notes();
    reasons_.insert(reasons_.end(), divider_.reasons().begin(), divider_.reasons().end());
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
      if (rich.cell) rich.rounding = rounding_of(*rich.cell);
    }
  }

  /// Every value is off by half a unit at most: the node's own, and those that its place takes.
  static double rounding_of(const RecognizedCell& cell) {
    double most = 0;
    for (const auto& left_out : cell.left_out) {
      double sum = 1;
      for (std::size_t n = 0; n < cell.weights.size(); ++n)
        for (const auto& [place, weight] : cell.weights[n])
          sum += std::abs(left_out.shape_functions[n] * weight);
      most = std::max(most, sum / 2);
    }
    return most;
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
      bool rounded = true;  // as far as the digits tell
      for (std::size_t v = 0; v < values_.size(); ++v) {
        exact &= rich.errors[v] <= values_[v].same;
        rounded &= rich.errors[v] <= std::max(values_[v].same, rich.rounding * values_[v].unit);
      }
      const bool high = rich.cell->order > 3;
      rich.turned = options_.approximate || (rounded && !high);
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
      mesh_.notes.push_back(note_of(what, rich, exact, rounded));
      if (!rounded) mesh_.metadata.emplace_back(kApproximated, mesh_.notes.back());
    }
  }

  [[nodiscard]] std::string note_of(const std::string& what, const RichType& rich, bool exact,
                                    bool rounded) const {
    const std::string_view kind = kind_name(rich.cell->kind);
    if (exact)
      return fmt::format(
          "{} became {}, which loses nothing: the nodes left out, and the fields "
          "there, are what the others make of them",
          what, kind);
    if (!rounded) return fmt::format("approximated {} by {}: {}", what, kind, errors_of(rich));
    return fmt::format(
        "{} became {}, which loses nothing but what the digits of the file round: {} "
        "({} units in the last digit are allowed: {:.3g} for nodes)",
        what, kind, errors_of(rich), rich.rounding, rich.rounding * values_.front().unit);
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

  ForeignMesh& mesh_;
  const ReadOptions& options_;
  const std::string& subject_;
  MeshRewrite rewrite_;
  std::vector<PointValues> values_;  ///< the coordinates first
  std::map<std::uint16_t, RichType> rich_;
  std::vector<std::string> reasons_;
  CellDivider divider_{mesh_, options_, subject_, rewrite_, values_};
};

}  // namespace

std::string reduce_cells(ForeignMesh& mesh, const ReadOptions& options,
                         std::span<const ForeignField* const> fields, const std::string& subject) {
  const bool any_rich =
      std::any_of(mesh.types.begin(), mesh.types.end(), [](const ForeignType& type) {
        return type.conversion.fate == CellFate::unsupported && type.conversion.corners;
      });
  const bool any_collapsed = options.approximate && has_repeated_nodes(mesh);
  if (mesh.polyhedra.cells.empty() && !any_collapsed &&
      (!any_rich || options.corners_of_unsupported))
    return {};
  return Reducer(mesh, options, fields, subject).run();
}

}  // namespace hiac::formats
