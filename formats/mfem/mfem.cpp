#include "formats/mfem/mfem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "formats/assemble.hpp"
#include "formats/edge_order.hpp"
#include "formats/foreign_mesh.hpp"
#include "formats/input_text.hpp"
#include "formats/mfem/dof_map.hpp"
#include "formats/mfem/mesh_file.hpp"
#include "hiac/base/error.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac::formats {
namespace {

using mfem::Element;
using mfem::Geometry;
using mfem::GridFunction;
using mfem::MeshFile;
using mfem::Space;

CellKind tetrahedron_of(int order) {
  return kind_of(CellShape::tetrahedron, static_cast<CellOrder>(order));
}

/// How cells of a geometry in a mesh of that order are converted.
CellConversion conversion_of(Geometry geometry, int order) {
  switch (geometry) {
    case Geometry::tetrahedron:
      return converted_to(tetrahedron_of(order));
    case Geometry::cube:
      return order == 1 ? converted_to(CellKind::brick8) : unsupported_with(CellKind::brick8);
    case Geometry::prism:
      return order == 1 ? converted_to(CellKind::prism6, kRightHandedPrism)
                        : unsupported_with(CellKind::prism6, kRightHandedPrism);
    case Geometry::pyramid:
      return order == 1 ? converted_to(CellKind::pyramid5) : unsupported_with(CellKind::pyramid5);
    default:
      return kNoVolume;
  }
}

/// The values of a tetrahedron's nodes, evenly spaced, component by component.
///
/// Of Gauss-Lobatto points: a cubic is told along an edge by its values at 0, g, 1-g and 1 with
/// g = (1 - 1/sqrt(5))/2, and so at the thirds. Vertices and middles of faces are in their places.
std::vector<double> even_values(const GridFunction& function, const Space& space,
                                const std::vector<std::size_t>& dofs, std::size_t component) {
  std::vector<double> values;
  for (const std::size_t dof : dofs) values.push_back(function.value(dof, component));
  if (!space.lobatto) return values;
  const double g = (1 - 1 / std::sqrt(5.0)) / 2;
  const std::array<double, 4> places{0, g, 1 - g, 1};
  std::size_t at = 4;
  for (const ShapeEdge& edge : topology_of(CellShape::tetrahedron).edges) {
    const std::array<double, 4> known{values[edge[0]], values[at], values[at + 1], values[edge[1]]};
    for (const double t : {1.0 / 3, 2.0 / 3}) {
      double sum = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        double weight = 1;
        for (std::size_t j = 0; j < 4; ++j)
          if (j != i) weight *= (t - places[j]) / (places[i] - places[j]);
        sum += weight * known[i];
      }
      values[at++] = sum;
    }
  }
  return values;
}

/// A function named by its file, and its space.
struct NamedFunction {
  std::string name;
  GridFunction values;
};

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {
    const InputText input(path);
    TextCursor text(input.text(), path);
    file_ = mfem::read_mesh_file(text);
    read_functions();
  }

  ForeignMesh read() {
    all_tetrahedra_ = std::all_of(file_.elements.begin(), file_.elements.end(), [](const auto& e) {
      return e.geometry == Geometry::tetrahedron;
    });
    if (!file_.nodes.values.empty())
      nodes_space_ = mfem::space_named(file_.nodes.collection, path_);
    choose_order();
    check_vertices();
    add_cells();
    add_points();
    add_attributes();
    for (const NamedFunction& function : functions_) add_function(function);
    return std::move(mesh_);
  }

 private:
  void read_functions() {
    const std::filesystem::path mesh(path_);
    std::vector<std::filesystem::path> names{std::filesystem::path(mesh).replace_extension("gf")};
    if (mesh.stem() == "refined" || mesh.stem() == "displaced")
      names.push_back(mesh.parent_path() / "sol.gf");
    for (const std::filesystem::path& name : names) {
      std::error_code ignored;
      if (!std::filesystem::is_regular_file(name, ignored)) continue;
      const InputText input(name.string());
      TextCursor text(input.text(), name.string());
      functions_.push_back({name.stem().string(), mfem::read_grid_function(text)});
    }
  }

  /// The order of the cells: the highest of the nodes' and the functions', on tetrahedra.
  void choose_order() {
    order_ = nodes_space_.order;
    if (!all_tetrahedra_) {
      if (order_ == 3)
        throw InputError(path_,
                         "has nodes of order 3 on cells other than "
                         "tetrahedra (order 1 or 2 expected)");
      return;
    }
    for (const NamedFunction& function : functions_)
      if (!mfem::is_piecewise_constant(function.values.collection))
        order_ = std::max(order_, mfem::space_named(function.values.collection, path_).order);
  }

  void check_vertices() const {
    for (std::size_t e = 0; e < file_.elements.size(); ++e) {
      const Element& element = file_.elements[e];
      for (std::size_t v = 0; v < mfem::vertex_count(element.geometry); ++v)
        if (element.vertices[v] < 0 ||
            static_cast<std::size_t>(element.vertices[v]) >= file_.vertex_count)
          throw InputError(path_, fmt::format("element {} names vertex {} (0 to {} expected)", e,
                                              element.vertices[v], file_.vertex_count - 1));
    }
  }

  void add_cells() {
    cells_ = std::make_unique<mfem::DofMap>(file_, Space{order_, false});
    for (std::size_t e = 0; e < file_.elements.size(); ++e) {
      const Element& element = file_.elements[e];
      const CellConversion conversion = conversion_of(element.geometry, order_);
      std::string name(mfem::geometry_name(element.geometry));
      if (conversion.fate == CellFate::unsupported) name += fmt::format(" of order {}", order_);
      std::vector<std::size_t> nodes;
      if (element.geometry == Geometry::tetrahedron)
        nodes = cells_->of(e);
      else
        nodes.assign(
            element.vertices.begin(),
            element.vertices.begin() + static_cast<long>(mfem::vertex_count(element.geometry)));
      mesh_.cell_types.push_back(mesh_.type_place(name, nodes.size(), conversion));
      mesh_.cell_nodes.insert(mesh_.cell_nodes.end(), nodes.begin(), nodes.end());
    }
  }

  /// A continuous function's values at the points of the cells.
  std::vector<double> at_points(const GridFunction& function, const Space& space) const {
    const mfem::DofMap map(file_, space);
    // faces and insides of cells other than tetrahedra have degrees of freedom too
    if (function.dofs() < map.size() || (all_tetrahedra_ && function.dofs() != map.size()))
      throw InputError(path_, fmt::format("a function of the space '{}' does not fit the mesh ({} "
                                          "degrees of freedom expected, {} found)",
                                          function.collection, map.size(), function.dofs()));
    const std::size_t width = function.components;
    std::vector<double> values(cells_->size() * width, 0);
    for (std::size_t v = 0; v < file_.vertex_count; ++v)
      for (std::size_t c = 0; c < width; ++c) values[v * width + c] = function.value(v, c);
    if (order_ == 1) return values;
    const CellKind kind = tetrahedron_of(order_);
    std::vector<double> shape(kMaxNodesPerCell);
    for (std::size_t e = 0; e < file_.elements.size(); ++e) {
      if (file_.elements[e].geometry != Geometry::tetrahedron) continue;
      const std::vector<std::size_t> points = cells_->of(e);
      const std::vector<std::size_t> dofs = map.of(e);
      for (std::size_t c = 0; c < width; ++c) {
        const std::vector<double> known = even_values(function, space, dofs, c);
        for (std::size_t p = 0; p < points.size(); ++p) {
          if (space.order == order_) {
            values[points[p] * width + c] = known[p];
            continue;
          }
          shape_functions<double>(tetrahedron_of(space.order), reference_nodes(kind)[p], shape);
          double sum = 0;
          for (std::size_t i = 0; i < known.size(); ++i) sum += shape[i] * known[i];
          values[points[p] * width + c] = sum;
        }
      }
    }
    return values;
  }

  void add_points() {
    GridFunction nodes = file_.nodes;
    if (nodes.values.empty()) {
      nodes.collection = "Linear";
      nodes.components = 3;
      nodes.by_vdim = true;
      for (const auto& point : file_.vertices)
        nodes.values.insert(nodes.values.end(), point.begin(), point.end());
    }
    if (nodes.components != 3)
      throw InputError(path_,
                       fmt::format("its nodes have {} coordinates (3 expected)", nodes.components));
    mesh_.xyz = at_points(nodes, nodes_space_);
  }

  void add_attributes() {
    std::vector<double> attributes;
    std::map<std::int64_t, std::vector<IndexRange>> ranges;
    for (std::size_t e = 0; e < file_.elements.size(); ++e) {
      const std::int64_t attribute = file_.elements[e].attribute;
      attributes.push_back(static_cast<double>(attribute));
      auto& runs = ranges[attribute];
      if (!runs.empty() && runs.back().end == e)
        ++runs.back().end;
      else
        runs.push_back({e, e + 1});
    }
    for (auto& [attribute, runs] : ranges)
      mesh_.blocks.push_back({fmt::format("{}", attribute), std::move(runs)});
    add_field("attribute", FieldLocation::cell, 1, std::move(attributes), "int32");
  }

  void add_function(const NamedFunction& function) {
    const GridFunction& values = function.values;
    if (mfem::is_piecewise_constant(values.collection)) {
      if (values.dofs() != file_.elements.size())
        throw InputError(path_,
                         fmt::format("a function of the space '{}' does not fit the mesh "
                                     "({} values expected, {} found)",
                                     values.collection, file_.elements.size(), values.dofs()));
      std::vector<double> of_cells;
      for (std::size_t e = 0; e < values.dofs(); ++e)
        for (std::size_t c = 0; c < values.components; ++c) of_cells.push_back(values.value(e, c));
      add_field(function.name, FieldLocation::cell, values.components, std::move(of_cells),
                "double");
      return;
    }
    const Space space = mfem::space_named(values.collection, path_);
    if (space.order > order_) {
      mesh_.notes.push_back(fmt::format("left out '{}' of order {} on cells of order {}",
                                        function.name, space.order, order_));
      return;
    }
    add_field(function.name, FieldLocation::node, values.components, at_points(values, space),
              "double");
  }

  void add_field(const std::string& name, FieldLocation location, std::size_t components,
                 std::vector<double>&& values, const char* type) {
    ForeignField field;
    field.name = name;
    field.location = location;
    field.components = static_cast<std::uint32_t>(components);
    field.type = type;
    field.values = [kept = std::make_shared<const std::vector<double>>(std::move(values))] {
      return *kept;
    };
    mesh_.fields.push_back(std::move(field));
  }

  std::string path_;
  MeshFile file_;
  std::vector<NamedFunction> functions_;
  bool all_tetrahedra_ = true;
  Space nodes_space_{1, false};
  int order_ = 1;
  std::unique_ptr<mfem::DofMap> cells_;
  ForeignMesh mesh_;
};

}  // namespace

Format mfem_format() {
  Format format;
  format.name = "mfem";
  format.extensions = {".mesh"};
  format.kinds = "tet4-20 pyr5 prism6 brick8";
  format.fields = "node, cell";
  format.time_steps = "one";
  format.recognizes = [](std::string_view head) {
    return head.starts_with("MFEM mesh v") || head.starts_with("MFEM NC mesh v");
  };
  read_through(format,
               [](const std::string& path, const ReadOptions&) { return Reader(path).read(); });
  return format;
}

}  // namespace hiac::formats
