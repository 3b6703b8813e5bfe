#include "hiac/mesh/atomic_file.hpp"

#include <filesystem>
#include <system_error>

#include "hiac/base/output_file.hpp"
#include "hiac/mesh/file_descriptor.hpp"

namespace hiac {
namespace {

void write_and_close(const std::string& opened, const std::string& path,
                     const std::function<void(int descriptor)>& write) {
  FileDescriptor output = open_to_write(opened);
  write(output.number());
  output.close(path);
}

}  // namespace

void write_atomically(const std::string& path, const std::function<void(int descriptor)>& write) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  // pipes and devices cannot be replaced by renaming
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return write_and_close(path, path, write);
  OutputFile file(path);
  write_and_close(file.temporary_path(), path, write);
  file.commit();
}

}  // namespace hiac
