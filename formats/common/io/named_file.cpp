#include "formats/common/io/named_file.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {

std::string file_head(const std::string& path) {
  std::error_code status_error;
  if (std::filesystem::is_directory(path, status_error))
    throw InputError(path, "is a directory (a file expected)");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, fmt::format("cannot be opened ({})", std::strerror(errno)));
  std::string head(kHeadBytes, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (file.bad()) throw InputError(path, fmt::format("cannot be read ({})", std::strerror(errno)));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

std::string file_beside(const std::string& path, const std::string& named) {
  const auto is_control = [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; };
  if (std::any_of(named.begin(), named.end(), is_control))
    throw InputError(path, "names a file with control characters in its name");
  return (std::filesystem::path(path).parent_path() / named).string();
}

}  // namespace hiac::formats
