#include "formats/mfem/mfem.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "formats/common/cells/edge_order.hpp"
#include "formats/common/io/input_text.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/mfem/dof_map.hpp"
#include "formats/mfem/interpolation.hpp"
#include "formats/mfem/mesh_file.hpp"
#include "hiac/base/error.hpp"

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

/// A function with the name of its file, and its space.
struct NamedFunction {
  std::string name;
  GridFunction values;
};

class MfemReader {
 public:
  explicit MfemReader(const std::string& path) : path_(path) {
    const InputText input(path);
    TextCursor text(input.text(), path);
    file_ = mfem::read_mesh_file(text);
    mesh_.notes = file_.notes;
    read_functions();
  }

  ForeignMesh read() {
    all_tetrahedra_ = std::all_of(file_.elements.begin(), file_.elements.end(), [](const auto& e) {
      return e.geometry == Geometry::tetrahedron;
    });
    any_pyramid_ = std::any_of(file_.elements.begin(), file_.elements.end(),
                               [](const auto& e) { return e.geometry == Geometry::pyramid; });
    if (!file_.nodes.values.empty()) {
      const auto space = mfem::space_named(file_.nodes.collection);
      if (!space)
        throw InputError(path_, fmt::format("its nodes are in the space '{}', which cannot be held "
                                            "(H1_3D_P1 to H1_3D_P8, H1Pos_3D_P1 to H1Pos_3D_P8, "
                                            "Linear, Quadratic or Cubic expected)",
                                            file_.nodes.collection));
      nodes_space_ = *space;
    }
    choose_order();
    check_vertices();
    if (!file_.nodes.values.empty()) nodes_space_ = with_its_points(file_.nodes, nodes_space_);
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

  /// Chooses the order of the cells: that of the nodes or, if all cells are tetrahedra, the highest
  /// order of the nodes and the functions.
  void choose_order() {
    order_ = nodes_space_.order;
    for (const Element& element : file_.elements)
      if (!mfem::can_be_of(element.geometry, nodes_space_))
        throw InputError(path_, fmt::format("has nodes of order {} on {}s, which are not read",
                                            order_, mfem::geometry_name(element.geometry)));
    if (order_ > 1 && file_.refined)
      throw InputError(path_, fmt::format("has nodes of order {} and hanging nodes, which are not "
                                          "read together",
                                          order_));
    if (!all_tetrahedra_) return;
    for (const NamedFunction& function : functions_) {
      const auto space = mfem::space_named(function.values.collection);
      if (space && mfem::can_be_of(Geometry::tetrahedron, *space))
        order_ = std::max(order_, space->order);
    }
  }

  /// The space with the points that its pyramids have in their interior, which its name does not
  /// tell but the number of degrees of freedom does.
  [[nodiscard]] Space with_its_points(const GridFunction& function, const Space& space) const {
    if (!any_pyramid_ || space.order == 1) return space;
    Space narrowing = space;
    narrowing.narrowing = true;
    const bool fits = function.dofs() == mfem::DofMap(file_, narrowing).size();
    return fits && function.dofs() != mfem::DofMap(file_, space).size() ? narrowing : space;
  }

  [[nodiscard]] bool can_be_of_all(const Space& space) const {
    return std::all_of(file_.elements.begin(), file_.elements.end(), [&](const Element& element) {
      return mfem::can_be_of(element.geometry, space);
    });
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
    cells_ = std::make_unique<mfem::DofMap>(file_, space_of_cells());
    for (std::size_t e = 0; e < file_.elements.size(); ++e) {
      const Element& element = file_.elements[e];
      const CellConversion conversion = conversion_of(element.geometry, order_);
      std::string name(mfem::geometry_name(element.geometry));
      if (conversion.fate == CellFate::unsupported) name += fmt::format(" of order {}", order_);
      const std::vector<std::size_t> nodes = cells_->of(e);
      const std::uint16_t type = mesh_.type_place(name, nodes.size(), conversion);
      if (conversion.fate == CellFate::unsupported && mesh_.types[type].places.empty())
        mesh_.types[type].places = places_of(element.geometry);
      mesh_.cell_types.push_back(type);
      mesh_.cell_nodes.insert(mesh_.cell_nodes.end(), nodes.begin(), nodes.end());
    }
  }

  /// The evenly spaced nodes of the cells.
  [[nodiscard]] Space space_of_cells() const { return {order_, false, nodes_space_.narrowing}; }

  [[nodiscard]] std::vector<std::array<double, 3>> places_of(Geometry geometry) const {
    std::vector<std::array<double, 3>> places;
    for (const mfem::LatticePoint& point : mfem::lattice_points(geometry, space_of_cells()))
      places.push_back(mfem::position_of(point, order_));
    return places;
  }

  /// The values of a continuous function at the points of the cells.
  std::vector<double> at_points(const GridFunction& function, const Space& space) const {
    const mfem::DofMap map(file_, space);
    if (function.dofs() != map.size())
      throw InputError(path_, fmt::format("a function of the space '{}' does not fit the mesh ({} "
                                          "degrees of freedom expected, {} found)",
                                          function.collection, map.size(), function.dofs()));
    const std::size_t width = function.components;
    std::vector<double> values(cells_->size() * width, 0);
    for (std::size_t v = 0; v < file_.vertex_count; ++v)
      for (std::size_t c = 0; c < width; ++c) values[v * width + c] = function.value(v, c);
    if (order_ == 1) return values;
    std::map<Geometry, std::vector<std::vector<double>>> weights;
    for (std::size_t e = 0; e < file_.elements.size(); ++e) {
      const Geometry geometry = file_.elements[e].geometry;
      std::vector<std::vector<double>>& rows = weights[geometry];
      if (rows.empty()) rows = mfem::interpolation(geometry, space, space_of_cells());
      const std::vector<std::size_t> points = cells_->of(e);
      const std::vector<std::size_t> dofs = map.of(e);
      for (std::size_t p = 0; p < points.size(); ++p)
        for (std::size_t c = 0; c < width; ++c) {
          double sum = 0;
          for (std::size_t i = 0; i < dofs.size(); ++i)
            if (rows[p][i] != 0) sum += rows[p][i] * function.value(dofs[i], c);
          values[points[p] * width + c] = sum;
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
    auto space = mfem::space_named(values.collection);
    if (!space) {
      mesh_.notes.push_back(
          fmt::format("left out '{}' of the space '{}' (H1_3D_P1 to H1_3D_P8, "
                      "H1Pos_3D_P1 to H1Pos_3D_P8, Linear, Quadratic, Cubic or L2 of order 0 are "
                      "read)",
                      function.name, values.collection));
      return;
    }
    if (space->order > order_ || !can_be_of_all(*space)) {
      mesh_.notes.push_back(fmt::format("left out '{}' of order {} on cells of order {}",
                                        function.name, space->order, order_));
      return;
    }
    space = with_its_points(values, *space);
    if (space->order == order_ && space->narrowing != nodes_space_.narrowing &&
        mfem::DofMap(file_, *space).size() != cells_->size()) {
      mesh_.notes.push_back(
          fmt::format("left out '{}', whose pyramids do not have the points inside that those of "
                      "the mesh have",
                      function.name));
      return;
    }
    add_field(function.name, FieldLocation::node, values.components, at_points(values, *space),
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
  bool any_pyramid_ = false;
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
    return head.starts_with("MFEM ") &&
           head.substr(0, head.find('\n')).find(" mesh v") < head.size();
  };
  read_through(format,
               [](const std::string& path, const ReadOptions&) { return MfemReader(path).read(); });
  return format;
}

}  // namespace hiac::formats
