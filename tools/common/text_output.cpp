#include "tools/common/text_output.hpp"

#include <cstdio>
#include <fstream>

#include "hiac/base/error.hpp"
#include "hiac/base/output_file.hpp"
#include "tools/common/mesh_io.hpp"

namespace hiac::tools {

void write_text(const std::string& path, const std::string& text) {
  if (is_stdout(path)) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
      throw InputError("stdout", "cannot be written");
    return;
  }
  OutputFile file(path);
  std::ofstream out(file.temporary_path());
  out << text << std::flush;
  if (!out) throw InputError(path, "cannot be written");
  file.commit();
}

}  // namespace hiac::tools
