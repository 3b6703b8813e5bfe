#include "tools/common/text_output.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/output_file.hpp"
#include "tools/common/mesh_io.hpp"

namespace hiac::tools {
namespace {

void require_written(bool written, const std::string& subject) {
  if (!written)
    throw InputError(subject, fmt::format("cannot be written ({})", std::strerror(errno)));
}

bool put(std::FILE* file, const std::string& text) {
  return std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
}

}  // namespace

void write_text(const std::string& path, const std::string& text) {
  if (is_stdout(path)) return require_written(put(stdout, text), "stdout");
  OutputFile output(path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      std::fopen(output.temporary_path().c_str(), "wb"), std::fclose);
  require_written(file != nullptr && put(file.get(), text), path);
  output.commit();
}

}  // namespace hiac::tools
