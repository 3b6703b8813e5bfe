#include "tools/common/run_files.hpp"

#include <filesystem>
#include <map>
#include <system_error>

#include <fmt/format.h>
#include <sys/stat.h>

#include "hiac/base/error.hpp"
#include "hiac/base/output_file.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/scene/paraview/paraview_view.hpp"
#include "tools/common/mesh_io.hpp"

namespace hiac::tools {
namespace {

namespace fs = std::filesystem;

// What two paths have in common if they name one file, which may not be there yet: its device and
// number, or else its whole path.
std::string identity_of(const std::string& path) {
  struct stat found = {};
  if (stat(path.c_str(), &found) == 0) return fmt::format("{} {}", found.st_dev, found.st_ino);
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(path), error).string();
}

// A state of ParaView may be named with a view of it behind its path.
std::string file_of_input(const std::string& input) {
  return is_paraview_file(input) ? paraview_file_of(input) : input;
}

// Refuses outputs that are inputs, or each other's files. There may be thousands, one for every
// frame: their identities are looked up, not compared pair by pair.
void require_own_files(const RunFiles& files) {
  std::map<std::string, const RunOutput*> seen;  // null: an input
  for (const std::string& input : files.inputs)
    if (!is_stdout(input)) seen.emplace(identity_of(file_of_input(input)), nullptr);
  for (const RunOutput& output : files.outputs) {
    if (is_stdout(output.path) || is_stream(output.path)) continue;
    const auto [at, is_new] = seen.emplace(identity_of(output.path), &output);
    if (is_new) continue;
    if (at->second != nullptr)
      throw UsageError(fmt::format("{} {}: is also the file of {} (another name expected)",
                                   output.option, output.path, at->second->option));
    if (!output.may_replace_input)
      throw UsageError(
          fmt::format("{} {}: is an input of this run, which would be lost (another "
                      "name expected)",
                      output.option, output.path));
    at->second = &output;
  }
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
  require_own_files(files);
  for (const RunOutput& output : files.outputs) {
    if (is_stdout(output.path) || is_stream(output.path)) continue;
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
