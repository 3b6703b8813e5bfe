#include "formats/silo/silo_file.hpp"

#include <fmt/format.h>

#include "formats/common/io/named_file.hpp"
#include "formats/hdf5/external_files.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::silo {
namespace {

template <typename Number>
std::vector<double> copied(const void* data, std::size_t count) {
  const auto* from = static_cast<const Number*>(data);
  std::vector<double> result(count);
  for (std::size_t i = 0; i < count; ++i) result[i] = static_cast<double>(from[i]);
  return result;
}

}  // namespace

SiloFiles::SiloFiles(const std::string& path) : path_(path) {
  DBShowErrors(DB_NONE, nullptr);
  open(path);
}

SiloFiles::~SiloFiles() {
  for (const auto& [path, file] : files_) DBClose(file);
}

DBfile* SiloFiles::open(const std::string& path) {
  const auto known = files_.find(path);
  if (known != files_.end()) return known->second;
  hdf5::require_local_links(path);
  DBfile* file = DBOpen(path.c_str(), DB_UNKNOWN, DB_READ);
  if (file == nullptr) throw InputError(path, "cannot be opened by Silo (a Silo file expected)");
  files_[path] = file;
  return file;
}

Place SiloFiles::place_of(const std::string& name) const {
  const std::size_t colon = name.find(':');
  if (colon == std::string::npos) return {path_, name};
  return {file_beside(path_, name.substr(0, colon)), name.substr(colon + 1)};
}

std::vector<double> numbers(const void* data, int type, std::size_t count,
                            const std::string& subject) {
  if (data == nullptr) throw InputError(subject, "has no values where there should be some");
  switch (type) {
    case DB_FLOAT:
      return copied<float>(data, count);
    case DB_DOUBLE:
      return copied<double>(data, count);
    case DB_INT:
      return copied<int>(data, count);
    case DB_SHORT:
      return copied<short>(data, count);
    case DB_LONG:
      return copied<long>(data, count);
    case DB_LONG_LONG:
      return copied<long long>(data, count);
    case DB_CHAR:
      return copied<char>(data, count);
    default:
      throw InputError(subject, fmt::format("values of Silo's type {} (numbers expected)", type));
  }
}

}  // namespace hiac::formats::silo
