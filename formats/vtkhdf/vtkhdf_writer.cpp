#include "formats/vtkhdf/vtkhdf_writer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <hdf5.h>

#include "formats/vtk/written_cells.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/output_file.hpp"

namespace hiac::formats {
namespace {

constexpr const char* kWrittenRoot = "/VTKHDF";

/// The library could not do what was requested.
struct Refused : std::runtime_error {
  Refused() : std::runtime_error("HDF5 refuses") {}
};

/// An HDF5 object, closed by the destructor.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {
    if (id_ < 0) throw Refused();
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  [[nodiscard]] hid_t get() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

class Writer {
 public:
  explicit Writer(const std::string& destination)
      : file_(H5Fcreate(destination.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose) {}

  void group(const std::string& name) const {
    const Handle group(H5Gcreate2(file_.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Gclose);
  }

  /// `memory`: the type of the numbers in memory, which is also stored.
  void dataset(const std::string& name, const std::vector<hsize_t>& shape, hid_t memory,
               const void* data) const {
    const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                       H5Sclose);
    const Handle set(H5Dcreate2(file_.get(), name.c_str(), memory, space.get(), H5P_DEFAULT,
                                H5P_DEFAULT, H5P_DEFAULT),
                     H5Dclose);
    const bool empty = std::find(shape.begin(), shape.end(), 0U) != shape.end();
    if (empty) return;
    check(H5Dwrite(set.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data));
    // closing the dataset reports no lost data
    check(H5Dflush(set.get()));
  }
  void count(const std::string& name, std::int64_t value) const {
    dataset(name, {1}, H5T_NATIVE_INT64, &value);
  }

  void attribute(const char* name, const std::vector<std::int64_t>& values,
                 const std::string& object) const {
    const hsize_t size = values.size();
    const Handle space(size == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr),
                       H5Sclose);
    write_attribute(object, name, H5T_NATIVE_INT64, space, values.data());
  }
  void type_attribute(const std::string& text) const {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    check(H5Tset_size(type.get(), text.size()));
    check(H5Tset_strpad(type.get(), H5T_STR_NULLPAD));
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    write_attribute(kWrittenRoot, "Type", type.get(), space, text.data());
  }

  void finish() const { check(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL)); }

 private:
  void write_attribute(const std::string& object, const char* name, hid_t type, const Handle& space,
                       const void* data) const {
    const Handle owner(H5Gopen2(file_.get(), object.c_str(), H5P_DEFAULT), H5Gclose);
    const Handle attribute(
        H5Acreate2(owner.get(), name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    check(H5Awrite(attribute.get(), type, data));
  }
  void check(herr_t status) const {
    if (status < 0) throw Refused();
  }

  Handle file_;
};

void write_cells(const Writer& writer, const ZooMesh& mesh, const vtk::WrittenCells& table) {
  std::vector<std::uint8_t> types;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int64_t> connectivity;
  types.reserve(mesh.cell_count());
  offsets.reserve(mesh.cell_count() + 1);
  connectivity.reserve(mesh.nodes.size());
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const vtk::WrittenCell& written = *table[static_cast<std::size_t>(mesh.kinds[cell])];
    const auto nodes = mesh.cell_nodes(cell);
    types.push_back(static_cast<std::uint8_t>(written.type));
    if (written.nodes.empty()) connectivity.insert(connectivity.end(), nodes.begin(), nodes.end());
    for (const std::uint8_t n : written.nodes) connectivity.push_back(nodes[n]);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  const std::string root = std::string(kWrittenRoot) + "/";
  writer.count(root + "NumberOfCells", static_cast<std::int64_t>(types.size()));
  writer.count(root + "NumberOfConnectivityIds", static_cast<std::int64_t>(connectivity.size()));
  writer.dataset(root + "Types", {types.size()}, H5T_NATIVE_UINT8, types.data());
  writer.dataset(root + "Offsets", {offsets.size()}, H5T_NATIVE_INT64, offsets.data());
  writer.dataset(root + "Connectivity", {connectivity.size()}, H5T_NATIVE_INT64,
                 connectivity.data());
}

/// The names under which fields are stored in the groups PointData and CellData.
struct StoredFields {
  std::set<std::string> point;
  std::set<std::string> cell;
};

StoredFields write_fields(const Writer& writer, const ZooMesh& mesh, const std::string& path,
                          std::vector<std::string>& notes) {
  StoredFields stored;
  for (const Field& field : mesh.fields) {
    if (field.location == FieldLocation::corner) {
      notes.push_back(
          fmt::format("field '{}' lives on cell corners, which VTKHDF cannot hold: "
                      "left out",
                      field.name));
      continue;
    }
    const bool on_nodes = field.location == FieldLocation::node;
    std::string name = field.name;
    std::replace(name.begin(), name.end(), '/', '_');
    if (name != field.name)
      notes.push_back(fmt::format("field '{}' is called '{}' in the file, where / parts folders",
                                  field.name, name));
    if (!(on_nodes ? stored.point : stored.cell).insert(name).second || name.empty())
      throw InputError(path, fmt::format("VTKHDF cannot hold two fields of one name in one place, "
                                         "nor one without a name ('{}' found: rename it)",
                                         name));
    if (!field.unit.empty())
      notes.push_back(fmt::format("the unit of field '{}' ({}) is left out", name, field.unit));
    const std::span<const double> values = field.values.view();
    std::vector<hsize_t> shape{values.size() / field.components};
    if (field.components > 1) shape.push_back(field.components);
    writer.dataset(fmt::format("{}/{}/{}", kWrittenRoot, on_nodes ? "PointData" : "CellData", name),
                   shape, H5T_NATIVE_DOUBLE, values.data());
  }
  return stored;
}

/// Writes the one step: all lists begin at 0.
void write_step(const Writer& writer, double time, const StoredFields& fields) {
  const std::string steps = std::string(kWrittenRoot) + "/Steps";
  writer.group(steps);
  writer.attribute("NSteps", {1}, steps);
  writer.dataset(steps + "/Values", {1}, H5T_NATIVE_DOUBLE, &time);
  writer.count(steps + "/PartOffsets", 0);
  writer.count(steps + "/NumberOfParts", 1);
  writer.count(steps + "/PointOffsets", 0);
  const std::int64_t zero = 0;
  for (const char* name : {"/CellOffsets", "/ConnectivityIdOffsets"})
    writer.dataset(steps + name, {1, 1}, H5T_NATIVE_INT64, &zero);
  writer.group(steps + "/PointDataOffsets");
  writer.group(steps + "/CellDataOffsets");
  for (const std::string& name : fields.point) writer.count(steps + "/PointDataOffsets/" + name, 0);
  for (const std::string& name : fields.cell) writer.count(steps + "/CellDataOffsets/" + name, 0);
}

/// The time in the metadata; notes name the other metadata, which are left out.
std::optional<double> time_of(const ZooMesh& mesh, std::vector<std::string>& notes) {
  std::optional<double> time;
  for (const auto& [key, text] : mesh.metadata) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (key == "time" && error == std::errc() && end == text.data() + text.size())
      time = value;
    else if (key != "source")
      notes.push_back(fmt::format("metadata '{}' is left out", key));
  }
  return time;
}

}  // namespace

std::vector<std::string> write_vtkhdf(const std::string& path, const ZooMesh& mesh) {
  std::vector<std::string> notes;
  const vtk::WrittenCells table = vtk::written_cells(mesh, "VTKHDF", path, notes);
  const std::optional<double> time = time_of(mesh, notes);
  // the library would try again at exit to write what it could not write, and would crash
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  OutputFile file(path);
  try {
    const Writer writer(file.temporary_path());
    const std::string root = kWrittenRoot;
    for (const std::string& group : {root, root + "/PointData", root + "/CellData"})
      writer.group(group);
    // older readers know only version 1, which has no steps
    writer.attribute("Version", {time ? 2 : 1, 0}, root);
    writer.type_attribute("UnstructuredGrid");
    writer.count(root + "/NumberOfPoints", static_cast<std::int64_t>(mesh.node_count()));
    writer.dataset(root + "/Points", {mesh.node_count(), 3}, H5T_NATIVE_DOUBLE, mesh.xyz.data());
    write_cells(writer, mesh, table);
    const StoredFields fields = write_fields(writer, mesh, path, notes);
    if (time) write_step(writer, *time, fields);
    writer.finish();
  } catch (const Refused& refused) {
    file.fail(refused.what());
  }
  file.commit();
  return notes;
}

}  // namespace hiac::formats
