#include "tools/common/run_files.hpp"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/output_file.hpp"
#include "hiac/image/image_io.hpp"
#include "tools/common/mesh_io.hpp"

namespace hiac::tools {
namespace {

namespace fs = std::filesystem;

// Whether two paths name one file, which may not be there yet.
bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::exists(a, error) && fs::exists(b, error)) return fs::equivalent(a, b, error);
  return fs::weakly_canonical(fs::absolute(a), error) ==
         fs::weakly_canonical(fs::absolute(b), error);
}

void require_own_file(const RunFiles& files, std::size_t at) {
  const RunOutput& output = files.outputs[at];
  for (const std::string& input : files.inputs)
    if (!is_stdout(input) && !output.may_replace_input && same_file(input, output.path))
      throw UsageError(
          fmt::format("{} {}: is an input of this run, which would be lost (another "
                      "name expected)",
                      output.option, output.path));
  for (std::size_t other = 0; other < at; ++other)
    if (!is_stdout(files.outputs[other].path) && same_file(files.outputs[other].path, output.path))
      throw UsageError(fmt::format("{} {}: is also the file of {} (another name expected)",
                                   output.option, output.path, files.outputs[other].option));
}

}  // namespace

void require_same_kind(const RunOutput& output) {
  const auto found = kind_of_file(output.path);
  if (found && *found != output.kind)
    throw UsageError(
        fmt::format("{} {}: is a file of another kind, which would be lost ({} "
                    "expected, or no file; {} found)",
                    output.option, output.path, kind_phrase(output.kind), kind_phrase(*found)));
}

void require_safe(const RunFiles& files) {
  for (std::size_t at = 0; at < files.outputs.size(); ++at) {
    const RunOutput& output = files.outputs[at];
    if (is_stdout(output.path) || is_stream(output.path)) continue;
    require_own_file(files, at);
    require_same_kind(output);
    require_writable(output.path);
  }
}

std::vector<std::string> image_parts(const std::string& path,
                                     const std::vector<std::string>& further_channels) {
  if (path.empty() || !has_image_extension(path)) return {path};
  return files_of_image(path, further_channels);
}

void add_image(std::vector<RunOutput>& outputs, const std::string& option, const std::string& path,
               const std::vector<std::string>& further_channels) {
  for (std::string& part : image_parts(path, further_channels))
    outputs.push_back({option, std::move(part), FileKind::image});
}

}  // namespace hiac::tools
