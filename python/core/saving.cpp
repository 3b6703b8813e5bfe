#include "python/core/saving.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/output_file.hpp"

namespace py = pybind11;

namespace hiac::python {
namespace {

void write_specification(const std::string& path, const std::string& text) {
  require_same_kind(path, tools::FileKind::specification);
  OutputFile output(path);
  std::ofstream file(output.temporary_path(), std::ios::binary);
  file << text;
  file.close();
  if (!file) output.fail(fmt::format("cannot be written ({})", std::strerror(errno)));
  output.commit();
}

}  // namespace

void require_same_kind(const std::string& path, tools::FileKind kind) {
  if (is_stream(path)) return;
  const auto found = tools::kind_of_file(path);
  if (found && *found != kind)
    throw UsageError(
        fmt::format("{}: is a file of another kind, which would be lost ({} expected, or "
                    "no file; {} found)",
                    path, kind_phrase(kind), kind_phrase(*found)));
}

void bind_saving(py::module_& module) {
  module.def("write_specification", &write_specification, py::arg("path"), py::arg("text"),
             py::call_guard<py::gil_scoped_release>());
}

}  // namespace hiac::python
