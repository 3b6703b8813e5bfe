#include "formats/exodus/netcdf_file.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_meta.h>

#include "formats/common/io/mapped_file.hpp"
#include "formats/common/io/product.hpp"
#include "formats/exodus/classic_layout.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::exodus {
namespace {

/// The highest compression ratio of the filters in netCDF-4 (deflate: 1032).
constexpr std::uint64_t kMostCompression = 1100;

std::size_t bytes_of(nc_type type) {
  switch (type) {
    case NC_BYTE:
    case NC_UBYTE:
    case NC_CHAR:
      return 1;
    case NC_SHORT:
    case NC_USHORT:
      return 2;
    case NC_INT:
    case NC_UINT:
    case NC_FLOAT:
      return 4;
    default:
      return 8;
  }
}

}  // namespace

NetcdfFile::NetcdfFile(const std::string& path) : path_(path) {
  {
    // where a classic file is cut off, the library returns zeros for the missing data
    const MappedFile file(path);
    file_size_ = file.text().size();
    packed_ = !is_classic_netcdf(file.text());
    if (!packed_) bytes_behind_ = file_size_ - check_classic_layout(file.text(), path);
  }
  if (const int status = nc_open(path.c_str(), NC_NOWRITE, &file_); status != NC_NOERR)
    throw InputError(path, fmt::format("is no whole netCDF file ({})", nc_strerror(status)));
}

NetcdfFile::~NetcdfFile() { nc_close(file_); }

void NetcdfFile::fail(const std::string& variable, std::string_view problem) const {
  throw InputError(path_, fmt::format("{}: {}", variable, problem));
}

std::size_t NetcdfFile::dimension(const std::string& name) const {
  int id = 0;
  std::size_t length = 0;
  if (nc_inq_dimid(file_, name.c_str(), &id) != NC_NOERR) return 0;
  if (nc_inq_dimlen(file_, id, &length) != NC_NOERR) fail(name, "cannot be read");
  return length;
}

bool NetcdfFile::has(const std::string& variable) const {
  int id = 0;
  return nc_inq_varid(file_, variable.c_str(), &id) == NC_NOERR;
}

int NetcdfFile::id_of(const std::string& variable) const {
  int id = 0;
  if (nc_inq_varid(file_, variable.c_str(), &id) != NC_NOERR) fail(variable, "is not there");
  return id;
}

std::vector<std::size_t> NetcdfFile::shape(const std::string& variable) const {
  const int id = id_of(variable);
  int rank = 0;
  if (nc_inq_varndims(file_, id, &rank) != NC_NOERR || rank < 0) fail(variable, "cannot be read");
  std::vector<int> dimensions(static_cast<std::size_t>(rank));
  if (nc_inq_vardimid(file_, id, dimensions.data()) != NC_NOERR) fail(variable, "cannot be read");
  std::vector<std::size_t> result(dimensions.size());
  for (std::size_t d = 0; d < result.size(); ++d)
    if (nc_inq_dimlen(file_, dimensions[d], &result[d]) != NC_NOERR)
      fail(variable, "cannot be read");
  return result;
}

std::string NetcdfFile::type(const std::string& variable) const {
  nc_type type = NC_NAT;
  nc_inq_vartype(file_, id_of(variable), &type);
  switch (type) {
    case NC_FLOAT:
      return "float";
    case NC_DOUBLE:
      return "double";
    case NC_CHAR:
      return "text";
    default:
      return fmt::format("int{}", 8 * bytes_of(type));
  }
}

std::size_t NetcdfFile::checked_size(const std::string& variable) const {
  nc_type type = NC_NAT;
  if (nc_inq_vartype(file_, id_of(variable), &type) != NC_NOERR) fail(variable, "cannot be read");
  const std::size_t size = product(shape(variable));
  const std::uint64_t most = file_size_ * (packed_ ? kMostCompression : 1) / bytes_of(type);
  if (size > most)
    fail(variable, fmt::format("declares {} values, more than a file of {} bytes can hold", size,
                               file_size_));
  return size;
}

std::vector<double> NetcdfFile::reals(const std::string& variable) const {
  std::vector<double> values(checked_size(variable));
  if (!values.empty() && nc_get_var_double(file_, id_of(variable), values.data()) != NC_NOERR)
    fail(variable, "cannot be read");
  return values;
}

std::vector<std::int64_t> NetcdfFile::integers(const std::string& variable) const {
  std::vector<long long> values(checked_size(variable));
  if (!values.empty() && nc_get_var_longlong(file_, id_of(variable), values.data()) != NC_NOERR)
    fail(variable, "cannot be read");
  return {values.begin(), values.end()};
}

std::vector<double> NetcdfFile::reals(const std::string& variable,
                                      const std::vector<std::size_t>& start,
                                      const std::vector<std::size_t>& count) const {
  static_cast<void>(checked_size(variable));
  const std::vector<std::size_t> extents = shape(variable);
  bool inside = extents.size() == start.size() && extents.size() == count.size();
  for (std::size_t d = 0; inside && d < extents.size(); ++d)
    inside = start[d] <= extents[d] && count[d] <= extents[d] - start[d];
  if (!inside) fail(variable, "does not have the extents that the mesh asks for");
  std::vector<double> values(product(count));
  if (!values.empty() && nc_get_vara_double(file_, id_of(variable), start.data(), count.data(),
                                            values.data()) != NC_NOERR)
    fail(variable, "cannot be read");
  return values;
}

std::vector<std::string> NetcdfFile::texts(const std::string& variable) const {
  if (!has(variable)) return {};
  const std::vector<std::size_t> extents = shape(variable);
  if (extents.size() != 2 || type(variable) != "text") fail(variable, "holds no names");
  std::string all(checked_size(variable), '\0');
  if (!all.empty() && nc_get_var_text(file_, id_of(variable), all.data()) != NC_NOERR)
    fail(variable, "cannot be read");
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < extents[0]; ++i) {
    std::string line = all.substr(i * extents[1], extents[1]);
    line.resize(std::min(line.find('\0'), line.size()));
    while (!line.empty() && line.back() == ' ') line.pop_back();
    lines.push_back(std::move(line));
  }
  return lines;
}

std::optional<std::string> NetcdfFile::text_attribute(const std::string& variable,
                                                      const std::string& name) const {
  const int id = variable.empty() ? NC_GLOBAL : id_of(variable);
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(file_, id, name.c_str(), &type, &length) != NC_NOERR || type != NC_CHAR ||
      length > file_size_)
    return std::nullopt;
  std::string text(length, '\0');
  if (nc_get_att_text(file_, id, name.c_str(), text.data()) != NC_NOERR) return std::nullopt;
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

std::string library_version() {
  return fmt::format("netCDF {}.{}.{}", NC_VERSION_MAJOR, NC_VERSION_MINOR, NC_VERSION_PATCH);
}

}  // namespace hiac::formats::exodus
