#include "formats/common/io/named_file.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "formats/common/io/printable.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

NamedFiles& named_files() {
  static NamedFiles allowed;
  return allowed;
}

}  // namespace

std::string file_head(const std::string& path) {
  std::error_code status_error;
  const auto status = std::filesystem::status(path, status_error);
  if (std::filesystem::is_directory(status))
    throw InputError(path, "is a directory (a file expected)");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError(path, "is not a regular file (a pipe or a device; a file expected)");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, fmt::format("cannot be opened ({})", std::strerror(errno)));
  std::string head(kHeadBytes, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (file.bad()) throw InputError(path, fmt::format("cannot be read ({})", std::strerror(errno)));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

void set_named_files(const NamedFiles& allowed) { named_files() = allowed; }

void require_local(const std::string& path, const std::string& named) {
  namespace fs = std::filesystem;
  if (named_files().outside_too) return;
  const auto whole = [](const fs::path& name) { return fs::absolute(name).lexically_normal(); };
  const std::string& folder = named_files().folder;
  const fs::path inside =
      whole(folder.empty() ? fs::path(path).parent_path() : fs::path(folder)) / "";
  const fs::path wanted = whole(named);
  const fs::path folders = inside.lexically_normal();
  // the normal form of a folder ends with an empty part
  const auto last = std::prev(folders.end());
  if (std::mismatch(folders.begin(), last, wanted.begin(), wanted.end()).first != last)
    throw InputError(path, fmt::format("names {}, which lies outside the input's folder "
                                       "(NamedFiles::outside_too reads it)",
                                       printable(wanted.string())));
}

std::string file_beside(const std::string& path, const std::string& named) {
  const auto is_control = [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; };
  if (std::any_of(named.begin(), named.end(), is_control))
    throw InputError(path, "names a file with control characters in its name");
  const auto found = std::filesystem::path(path).parent_path() / named;
  require_local(path, found.string());
  std::error_code error;
  const auto status = std::filesystem::status(found, error);
  if (std::filesystem::is_fifo(status) || std::filesystem::is_character_file(status))
    throw InputError(path, fmt::format("names {}, which is a pipe or a device (a file expected)",
                                       found.string()));
  return found.string();
}

}  // namespace hiac::formats
