#include "python/core/mesh.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "python/core/arrays.hpp"
#include "python/core/saving.hpp"

namespace hiac::python {
namespace {

using Handle = std::shared_ptr<MeshHandle>;
using Metadata = std::vector<std::pair<std::string, std::string>>;

FieldLocation location_named(const std::string& name) {
  if (name == "node") return FieldLocation::node;
  if (name == "cell") return FieldLocation::cell;
  if (name == "corner") return FieldLocation::corner;
  throw UsageError(fmt::format("field location `{}`: node, cell or corner expected", name));
}

const char* location_name(FieldLocation location) {
  switch (location) {
    case FieldLocation::node:
      return "node";
    case FieldLocation::cell:
      return "cell";
    default:
      return "corner";
  }
}

Field make_field(std::string name, const std::string& location, std::string unit,
                 const Contiguous<double>& values) {
  const std::size_t tuples = values.ndim() > 0 ? static_cast<std::size_t>(values.shape(0)) : 1;
  const std::size_t components = tuples == 0 ? 1 : static_cast<std::size_t>(values.size()) / tuples;
  return {std::move(name), std::move(unit), location_named(location),
          static_cast<std::uint32_t>(components), shared<double>(values)};
}

void require_kinds(const Contiguous<std::uint8_t>& kinds) {
  const std::uint8_t* begin = kinds.data();
  const auto* bad = std::find_if_not(begin, begin + kinds.size(), is_kind);
  if (bad != begin + kinds.size())
    throw InputError("mesh", fmt::format("cell {}: no kind has number {}", bad - begin, *bad));
}

Handle make_mesh(const Contiguous<double>& points, const Contiguous<std::uint8_t>& kinds,
                 const Contiguous<std::uint64_t>& offsets, const Contiguous<std::uint32_t>& nodes,
                 std::vector<Field> fields, Metadata metadata) {
  require_kinds(kinds);
  ZooMesh mesh;
  mesh.xyz = shared<double>(points);
  mesh.kinds = shared<CellKind>(kinds);
  mesh.elems = shared<std::uint64_t>(offsets);
  mesh.nodes = shared<NodeId>(nodes);
  mesh.fields = std::move(fields);
  mesh.metadata = std::move(metadata);
  {
    const py::gil_scoped_release released;
    validate(mesh, "mesh");
  }
  return std::make_shared<MeshHandle>(std::move(mesh));
}

py::array field_values(const Field& field) {
  const auto size = static_cast<py::ssize_t>(field.values.size());
  if (field.components == 1) return view<double>(field.values, {size});
  const auto components = static_cast<py::ssize_t>(field.components);
  return view<double>(field.values, {size / components, components});
}

void bind_arrays(py::class_<MeshHandle, Handle>& mesh) {
  mesh.def_property_readonly("points",
                             [](const MeshHandle& m) {
                               const auto rows = static_cast<py::ssize_t>(m.mesh().node_count());
                               return view<double>(m.mesh().xyz, {rows, 3});
                             })
      .def_property_readonly("kinds",
                             [](const MeshHandle& m) {
                               const auto cells = static_cast<py::ssize_t>(m.mesh().cell_count());
                               return view<std::uint8_t>(m.mesh().kinds, {cells});
                             })
      .def_property_readonly("offsets",
                             [](const MeshHandle& m) {
                               const auto& elems = m.mesh().elems;
                               return view<std::uint64_t>(elems,
                                                          {static_cast<py::ssize_t>(elems.size())});
                             })
      .def_property_readonly("nodes", [](const MeshHandle& m) {
        const auto& nodes = m.mesh().nodes;
        return view<std::uint32_t>(nodes, {static_cast<py::ssize_t>(nodes.size())});
      });
}

}  // namespace

void Drawer::require_drawable(const Scene& scene) {
  if (checked && *checked == scene) return;
  session.require_drawable(scene);
  checked = scene;
}

std::shared_ptr<Drawer> MeshHandle::take_drawer() {
  {
    const std::lock_guard lock(mutex_);
    if (idle_) return std::move(idle_);
  }
  return std::make_shared<Drawer>(mesh_);
}

void MeshHandle::keep(std::shared_ptr<Drawer> drawer) {
  const std::lock_guard lock(mutex_);
  if (!idle_) idle_ = std::move(drawer);
}

void bind_mesh(py::module_& module) {
  py::class_<Field>(module, "Field")
      .def(py::init(&make_field), py::arg("name"), py::arg("location"), py::arg("unit"),
           py::arg("values"))
      .def_readonly("name", &Field::name)
      .def_readonly("unit", &Field::unit)
      .def_property_readonly("location", [](const Field& f) { return location_name(f.location); })
      .def_property_readonly("values", &field_values);
  py::class_<MeshHandle, Handle> mesh(module, "Mesh");
  mesh.def(py::init(&make_mesh), py::arg("points"), py::arg("kinds"), py::arg("offsets"),
           py::arg("nodes"), py::arg("fields"), py::arg("metadata"))
      .def_property_readonly(
          "fields", [](const MeshHandle& m) { return std::vector<Field>(m.mesh().fields); })
      .def_property_readonly("metadata",
                             [](const MeshHandle& m) { return Metadata(m.mesh().metadata); })
      .def(
          "distinct_name",
          [](const MeshHandle& m, std::size_t k) {
            return distinct_name(m.mesh(), m.mesh().fields.at(k));
          },
          py::arg("index"))
      .def("scalar_names", [](const MeshHandle& m) { return scalar_field_names(m.mesh()); })
      .def(
          "scalar",
          [](const MeshHandle& m, const std::string& name) { return scalar_field(m.mesh(), name); },
          py::arg("name"))
      .def(
          "content_hash", [](const MeshHandle& m) { return content_hash(m.mesh()); },
          py::call_guard<py::gil_scoped_release>());
  bind_arrays(mesh);

  std::vector<std::string> names;
  for (std::size_t k = 0; k < kKindCount; ++k)
    names.emplace_back(kind_name(static_cast<CellKind>(k)));
  std::vector<std::size_t> counts;
  for (std::size_t k = 0; k < kKindCount; ++k)
    counts.push_back(node_count(static_cast<CellKind>(k)));
  module.attr("kind_names") = py::tuple(py::cast(names));
  module.attr("kind_nodes") = py::tuple(py::cast(counts));

  module.def(
      "read_zoo",
      [](const std::string& path) {
        return std::make_shared<MeshHandle>(read_zoo_file(path).mesh);
      },
      py::arg("path"), py::call_guard<py::gil_scoped_release>());
  module.def(
      "write_zoo",
      [](const MeshHandle& written, const std::string& path) {
        require_same_kind(path, tools::FileKind::mesh);
        write_zoo_file(path, {written.mesh(), {}});
      },
      py::arg("mesh"), py::arg("path"), py::call_guard<py::gil_scoped_release>());
  module.def(
      "write_zoo_stream",
      [](const MeshHandle& written, int descriptor) {
        write_zoo_stream(descriptor, {written.mesh(), {}}, "a pipe");
      },
      py::arg("mesh"), py::arg("descriptor"), py::call_guard<py::gil_scoped_release>());
}

}  // namespace hiac::python
