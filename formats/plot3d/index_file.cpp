#include "formats/plot3d/index_file.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "formats/common/io/mapped_file.hpp"
#include "formats/common/io/named_file.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::plot3d {
namespace {

using nlohmann::json;

std::string path_in(const json& entry, const char* key, const std::string& index) {
  const auto found = entry.find(key);
  if (found == entry.end() || !found->is_string()) return {};
  return file_beside(index, found->get<std::string>());
}

FileSet read_index(const std::string& path) {
  const MappedFile file(path);
  const json index = json::parse(file.text().begin(), file.text().end(), nullptr, false);
  if (index.is_discarded() || !index.is_object())
    throw InputError(path, "is no whole JSON object (an index of PLOT3D files expected)");
  FileSet files;
  const auto list = index.find("filenames");
  if (list == index.end() || !list->is_array() || list->empty())
    throw InputError(path, "names no files (a list under 'filenames' expected)");
  for (const json& entry : *list) {
    StepFiles step;
    const auto time = entry.is_object() ? entry.find("time") : entry.end();
    if (entry.is_object() && time != entry.end() && time->is_number())
      step.time = time->get<double>();
    if (entry.is_object()) {
      step.grid = path_in(entry, "xyz", path);
      step.q = path_in(entry, "q", path);
      step.function = path_in(entry, "function", path);
    }
    if (step.grid.empty())
      throw InputError(path, fmt::format("step {} names no grid (a name under 'xyz' expected)",
                                         files.steps.size()));
    files.steps.push_back(std::move(step));
  }
  std::stable_sort(files.steps.begin(), files.steps.end(),
                   [](const StepFiles& a, const StepFiles& b) { return a.time < b.time; });
  if (const auto names = index.find("function-names"); names != index.end() && names->is_array())
    for (const json& name : *names)
      if (name.is_string()) files.function_names.push_back(name.get<std::string>());
  return files;
}

/// The first candidate that exists, or nothing.
std::string existing(const std::vector<std::filesystem::path>& candidates) {
  std::error_code ignored;
  for (const std::filesystem::path& candidate : candidates)
    if (std::filesystem::is_regular_file(candidate, ignored)) return candidate.string();
  return {};
}

FileSet beside(const std::string& path) {
  const std::filesystem::path grid(path);
  const std::string stem = grid.stem().string();
  StepFiles step;
  step.grid = path;
  const auto named = [&](const char* letter) {
    std::vector<std::filesystem::path> candidates;
    if (grid.extension() != std::string(".") + letter)
      candidates.push_back(std::filesystem::path(grid).replace_extension(letter));
    if (const std::size_t at = stem.rfind("xyz"); at != std::string::npos) {
      std::string other = stem;
      other.replace(at, 3, letter);
      candidates.push_back(grid.parent_path() / (other + grid.extension().string()));
    }
    return existing(candidates);
  };
  step.q = named("q");
  step.function = named("f");
  return {{step}, {}};
}

}  // namespace

bool may_be_index(std::string_view head) {
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && head[first] == '{' &&
         head.find("\"filenames\"") != std::string_view::npos;
}

FileSet files_of(const std::string& path) {
  {
    const MappedFile file(path);
    if (!may_be_index(file.text().substr(0, 4096))) return beside(path);
  }
  return read_index(path);
}

}  // namespace hiac::formats::plot3d
