#include "hiac/mesh/atomic_file.hpp"

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
  // what is written front to back needs no copy of its own
  if (is_stream(path)) return write_and_close(path, path, write);
  OutputFile file(path);
  write_and_close(file.temporary_path(), path, write);
  file.commit();
}

}  // namespace hiac
