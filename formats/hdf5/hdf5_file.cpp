#include "formats/hdf5/hdf5_file.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <hdf5.h>

#include "formats/common/io/product.hpp"
#include "formats/hdf5/external_files.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::hdf5 {
namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

/// The highest compression ratio of the filters in HDF5 (deflate: 1032).
constexpr std::uint64_t kMostCompression = 1100;
constexpr std::uint64_t kMostAttributeValues = 65'536;

/// An HDF5 identifier, closed by the destructor with the function for its type.
class Id {
 public:
  Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): it is one
  [[nodiscard]] bool good() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

std::string type_name(hid_t type) {
  const std::size_t bits = 8 * H5Tget_size(type);
  switch (H5Tget_class(type)) {
    case H5T_FLOAT:
      return fmt::format("float{}", bits);
    case H5T_INTEGER:
      return fmt::format("{}int{}", H5Tget_sign(type) == H5T_SGN_NONE ? "u" : "", bits);
    case H5T_ENUM:
      return "int8";
    case H5T_STRING:
      return "text";
    default:
      return "other";
  }
}

bool is_number(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_FLOAT || kind == H5T_INTEGER || kind == H5T_ENUM;
}

std::vector<std::uint64_t> shape_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> shape(rank > 0 ? static_cast<std::size_t>(rank) : 0);
  if (rank > 0) H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return {shape.begin(), shape.end()};
}

/// The text up to its first zero or its trailing blanks.
std::string trimmed(std::string text) {
  text.resize(std::min(text.find('\0'), text.size()));
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

}  // namespace

std::uint64_t DatasetInfo::size() const { return product(shape); }

File::File(const std::string& path) : path_(path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  std::error_code failed;
  file_size_ = std::filesystem::file_size(path, failed);
  if (failed) throw InputError(path, fmt::format("cannot be read ({})", failed.message()));
  require_local_links(path);
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0) throw InputError(path, "is no whole HDF5 file (the library cannot open it)");
}

File::~File() { H5Fclose(file_); }

void File::fail(const std::string& object, std::string_view problem) const {
  throw InputError(path_, fmt::format("{}: {}", object, problem));
}

bool File::has(const std::string& name) const {
  // the library can look up a link only in groups that exist
  for (std::size_t end = name.find('/', 1); end != std::string::npos; end = name.find('/', end + 1))
    if (H5Lexists(file_, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  if (name == "/") return true;
  return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0 &&
         H5Oexists_by_name(file_, name.c_str(), H5P_DEFAULT) > 0;
}

bool File::is_group(const std::string& name) const {
  if (!has(name)) return false;
  const Id object(H5Oopen(file_, name.c_str(), H5P_DEFAULT), H5Oclose);
  return object.good() && H5Iget_type(object) == H5I_GROUP;
}

std::vector<std::string> File::children(const std::string& group) const {
  const Id id(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  if (!id.good()) fail(group, "no such group");
  std::vector<std::string> names;
  hsize_t at = 0;
  if (H5Literate(id, H5_INDEX_NAME, H5_ITER_NATIVE, &at, add_name, &names) < 0)
    fail(group, "cannot be listed");
  std::sort(names.begin(), names.end());
  return names;
}

DatasetInfo File::info(const std::string& dataset) const {
  const Id id(has(dataset) ? H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT) : -1, H5Dclose);
  if (!id.good()) fail(dataset, "no such dataset");
  const Id space(H5Dget_space(id), H5Sclose);
  const Id type(H5Dget_type(id), H5Tclose);
  if (!space.good() || !type.good()) fail(dataset, "cannot be read");
  return {shape_of(space), type_name(type)};
}

/// Refuses a dataset that declares more data than the file can hold.
void File::require_stored(std::int64_t dataset, const std::string& name) const {
  const Id space(H5Dget_space(dataset), H5Sclose);
  const Id type(H5Dget_type(dataset), H5Tclose);
  if (!space.good() || !type.good()) fail(name, "cannot be read");
  std::vector<std::uint64_t> extents = shape_of(space);
  extents.push_back(H5Tget_size(type));
  const std::uint64_t declared = product(extents);
  const std::uint64_t stored = H5Dget_storage_size(dataset);
  const Id properties(H5Dget_create_plist(dataset), H5Pclose);
  const bool filtered = properties.good() && H5Pget_nfilters(properties) > 0;
  const std::uint64_t most =
      std::max(std::min(stored, file_size_), file_size_ / 16) * (filtered ? kMostCompression : 1);
  if (declared > most)
    fail(name, fmt::format("declares {} bytes where the file holds {}", declared,
                           std::min(stored, file_size_)));
}

template <typename T>
std::vector<T> File::read(const std::string& dataset, const Slab* slab, std::int64_t type) const {
  const Id id(has(dataset) ? H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT) : -1, H5Dclose);
  if (!id.good()) fail(dataset, "no such dataset");
  require_stored(id, dataset);
  const Id stored_type(H5Dget_type(id), H5Tclose);
  if (!is_number(stored_type)) fail(dataset, "holds no numbers");
  const Id space(H5Dget_space(id), H5Sclose);
  std::vector<std::uint64_t> extents = shape_of(space);
  if (slab != nullptr) {
    if (slab->begin.size() != extents.size() || slab->count.size() != extents.size())
      fail(dataset,
           fmt::format("has {} dimensions ({} expected)", extents.size(), slab->begin.size()));
    for (std::size_t d = 0; d < extents.size(); ++d)
      if (slab->begin[d] > extents[d] || slab->count[d] > extents[d] - slab->begin[d])
        fail(dataset, fmt::format("holds {} along dimension {} ({} expected)", extents[d], d,
                                  slab->begin[d] + slab->count[d]));
    extents = slab->count;
  }
  std::vector<T> values(product(extents));
  if (values.empty()) return values;
  const std::vector<hsize_t> counts(extents.begin(), extents.end());
  const Id memory(H5Screate_simple(static_cast<int>(counts.size()), counts.data(), nullptr),
                  H5Sclose);
  if (slab != nullptr) {
    const std::vector<hsize_t> begin(slab->begin.begin(), slab->begin.end());
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, begin.data(), nullptr, counts.data(), nullptr) <
        0)
      fail(dataset, "cannot be read in part");
  }
  const bool whole = slab == nullptr;
  if (H5Dread(id, type, whole ? H5S_ALL : hid_t(memory), whole ? H5S_ALL : hid_t(space),
              H5P_DEFAULT, values.data()) < 0)
    fail(dataset, "cannot be read (damaged, or packed by a filter that is not here)");
  return values;
}

std::vector<double> File::reals(const std::string& dataset) const {
  return read<double>(dataset, nullptr, H5T_NATIVE_DOUBLE);
}

std::vector<double> File::reals(const std::string& dataset, const Slab& slab) const {
  return read<double>(dataset, &slab, H5T_NATIVE_DOUBLE);
}

std::vector<std::int64_t> File::integers(const std::string& dataset) const {
  return read<std::int64_t>(dataset, nullptr, H5T_NATIVE_INT64);
}

std::vector<std::int64_t> File::integers(const std::string& dataset, const Slab& slab) const {
  return read<std::int64_t>(dataset, &slab, H5T_NATIVE_INT64);
}

std::vector<std::string> File::texts(const std::string& dataset) const {
  const Id id(has(dataset) ? H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT) : -1, H5Dclose);
  if (!id.good()) fail(dataset, "no such dataset");
  require_stored(id, dataset);
  const Id type(H5Dget_type(id), H5Tclose);
  const Id space(H5Dget_space(id), H5Sclose);
  std::vector<std::uint64_t> extents = shape_of(space);
  std::size_t width = H5Tget_size(type);
  if (H5Tget_class(type) == H5T_INTEGER && width == 1 && extents.size() == 2) {
    width = extents.back();
    extents.pop_back();
  } else if ((H5Tget_class(type) != H5T_STRING && H5Tget_class(type) != H5T_ARRAY) ||
             H5Tis_variable_str(type) > 0) {
    fail(dataset, "holds no texts of fixed length");
  }
  const std::uint64_t count = product(extents);
  std::string all(count * width, '\0');
  if (!all.empty() && H5Dread(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()) < 0)
    fail(dataset, "cannot be read");
  std::vector<std::string> result;
  for (std::uint64_t i = 0; i < count; ++i) result.push_back(trimmed(all.substr(i * width, width)));
  return result;
}

bool File::has_attribute(const std::string& object, const std::string& name) const {
  return has(object) && H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

namespace {

/// The attribute's numbers as T.
template <typename T>
std::vector<T> attribute_values(hid_t file, const std::string& object, const std::string& name,
                                hid_t type) {
  const Id id(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
              H5Aclose);
  if (!id.good()) return {};
  const Id stored(H5Aget_type(id), H5Tclose);
  const Id space(H5Aget_space(id), H5Sclose);
  if (!stored.good() || !space.good() || !is_number(stored)) return {};
  const std::uint64_t size = product(shape_of(space));
  if (size == 0 || size > kMostAttributeValues) return {};
  std::vector<T> values(size);
  if (H5Aread(id, type, values.data()) < 0) return {};
  return values;
}

}  // namespace

std::vector<double> File::real_attribute(const std::string& object, const std::string& name) const {
  if (!has_attribute(object, name)) return {};
  return attribute_values<double>(file_, object, name, H5T_NATIVE_DOUBLE);
}

std::optional<std::int64_t> File::integer_attribute(const std::string& object,
                                                    const std::string& name) const {
  if (!has_attribute(object, name)) return std::nullopt;
  const auto values = attribute_values<std::int64_t>(file_, object, name, H5T_NATIVE_INT64);
  if (values.empty()) return std::nullopt;
  return values.front();
}

std::optional<std::string> File::text_attribute(const std::string& object,
                                                const std::string& name) const {
  if (!has_attribute(object, name)) return std::nullopt;
  const Id id(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
              H5Aclose);
  if (!id.good()) return std::nullopt;
  const Id type(H5Aget_type(id), H5Tclose);
  const Id space(H5Aget_space(id), H5Sclose);
  if (!type.good() || !space.good() || H5Tget_class(type) != H5T_STRING) return std::nullopt;
  if (product(shape_of(space)) != 1) return std::nullopt;
  if (H5Tis_variable_str(type) > 0) {
    char* text = nullptr;
    const Id memory(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(memory, H5T_VARIABLE);
    H5Tset_cset(memory, H5Tget_cset(type));
    if (H5Aread(id, memory, &text) < 0 || text == nullptr) return std::nullopt;
    std::string result = trimmed(text);
    H5free_memory(text);
    return result;
  }
  const std::size_t size = H5Tget_size(type);
  if (size == 0 || size > kMostAttributeValues) return std::nullopt;
  std::string text(size, '\0');
  if (H5Aread(id, type, text.data()) < 0) return std::nullopt;
  return trimmed(std::move(text));
}

std::string library_version() {
  return fmt::format("HDF5 {}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE);
}

}  // namespace hiac::formats::hdf5
