#include "tools/common/foreign_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/file_descriptor.hpp"
#include "hiac/mesh/metadata_keys.hpp"
#include "tools/common/as_option.hpp"
#include "tools/common/child_program.hpp"
#include "tools/common/file_kind.hpp"
#include "tools/common/mesh_io.hpp"
#include "tools/common/sibling_program.hpp"

namespace hiac::tools {
namespace {

constexpr const char* kConverter = "hiac-convert";
constexpr const char* kApproximate = "--approximate";

ChildProgram start(const std::vector<std::string>& arguments) {
  return start_program(places_of(kConverter), arguments, ChildPipe::output);
}

/// The last line of hiac-convert's messages, which says why it ended, without its name.
std::string reason_in(std::string messages) {
  while (messages.ends_with('\n')) messages.pop_back();
  std::string line = messages.substr(messages.rfind('\n') + 1);
  const std::string name = std::string(kConverter) + ": ";
  return line.starts_with(name) ? line.substr(name.size()) : line;
}

/// Waits for the end of the conversion and returns its messages; throws its reason where it failed.
std::string finish(const ChildProgram& conversion, const std::string& path) {
  const ChildEnd end = end_of(conversion);
  std::string messages = messages_of(conversion);
  if (end.is_success()) return messages;
  if (end.signal != 0)
    throw Error(ExitCode::internal,
                fmt::format("{}: {} was ended by signal {}", path, kConverter, end.signal));
  if (end.not_found)
    throw Error(ExitCode::internal,
                fmt::format("{}: is not a zoo mesh, and {} is neither beside this program nor on "
                            "PATH",
                            path, kConverter));
  const std::string reason = reason_in(std::move(messages));
  const std::string name = reason.find(path) == std::string::npos ? path + ": " : "";
  throw Error(static_cast<ExitCode>(end.exit_code), name + reason);
}

std::vector<std::string> arguments_for(const Tool& tool, const MeshInput& input,
                                       const std::vector<std::string>& further) {
  std::vector<std::string> arguments{kConverter};
  const auto given = as_option("--convert: ", [&] { return words_of(input.conversion); });
  for (const auto& words : {given, further})
    arguments.insert(arguments.end(), words.begin(), words.end());
  const CommonOptions& common = tool.common();
  if (common.quiet || input.is_silent) arguments.emplace_back("--quiet");
  if (common.verbose && !input.is_silent) arguments.emplace_back("--verbose");
  if (common.threads > 0) arguments.push_back(fmt::format("--threads={}", common.threads));
  if (common.max_memory > 0) arguments.push_back(fmt::format("--max-memory={}", common.max_memory));
  // a name that begins with a hyphen is no option
  arguments.push_back(input.path.starts_with('-') ? "./" + input.path : input.path);
  return arguments;
}

/// Whether options say what becomes of cells that the zoo has no kind for.
bool names_unsupported(const std::vector<std::string>& arguments) {
  constexpr std::array kNamed{kApproximate, "--skip-unsupported", "--corners-only"};
  return std::ranges::find_first_of(arguments, kNamed) != arguments.end();
}

bool is_approximated(const ZooMesh& mesh) {
  return std::ranges::any_of(mesh.metadata,
                             [](const auto& entry) { return entry.first == kApproximated; });
}

}  // namespace

void add_conversion(CLI::App& app, std::string& conversion) {
  app.add_option("--convert", conversion,
                 "Options of hiac-convert for a file that is no zoo mesh, in one word: --convert "
                 "'--step 3 --block top'")
      ->type_name("OPTIONS");
}

bool is_foreign_mesh(const std::string& path) {
  std::error_code error;
  if (path.empty() || path == "-") return false;
  if (std::filesystem::is_directory(path, error)) return true;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::string head(kZooMagic.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file) return false;  // whoever reads it says why
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  // the beginning of a zoo mesh is one, too; files of other formats may be empty (OpenFOAM's .foam)
  const bool named_zoo = std::filesystem::path(path).extension() == ".zoo";
  if (kZooMagic.starts_with(head) && (named_zoo || !head.empty())) return false;
  const auto kind = kind_of_file(path);
  if (kind && *kind != FileKind::mesh)
    throw InputError(path, fmt::format("is {} (a mesh expected)", kind_phrase(*kind)));
  return true;
}

ZooFile read_any_mesh(const Tool& tool, const MeshInput& input, MeshNumbers numbers,
                      const std::vector<std::string>& further) {
  if (!is_foreign_mesh(input.path)) {
    if (!input.conversion.empty())
      throw UsageError(
          fmt::format("--convert: {} is not a foreign file (a zoo mesh is read as it "
                      "is)",
                      input_name(input.path)));
    return read_mesh(input.path, numbers);
  }
  std::vector<std::string> arguments = arguments_for(tool, input, further);
  const bool may_approximate = input.may_approximate && !names_unsupported(arguments);
  if (may_approximate) arguments.insert(arguments.begin() + 1, kApproximate);
  ChildProgram conversion = start(arguments);
  std::optional<ZooFile> file;
  try {
    file = read_zoo_stream(conversion.stream.number(), input.path, numbers);
  } catch (const InputError&) {
    // no one reads on, so that the converter ends; what ended the stream is the better reason
    { const FileDescriptor closed(std::move(conversion.stream)); }
    finish(conversion, input.path);
    throw;
  }
  const std::string messages = finish(conversion, input.path);
  if (input.is_silent) return *std::move(file);
  // where nothing was to be approximated, the option had no part in it
  if (may_approximate && !is_approximated(file->mesh)) arguments.erase(arguments.begin() + 1);
  tool.note(fmt::format("{} is not a zoo mesh: read by {}", input.path, fmt::join(arguments, " ")));
  if (!messages.empty()) tool.print(messages);
  return *std::move(file);
}

std::size_t step_count(const Tool& tool, const MeshInput& input,
                       const std::vector<std::string>& further) {
  std::vector<std::string> listing{"--list", "--json=-"};
  listing.insert(listing.end(), further.begin(), further.end());
  ChildProgram conversion = start(arguments_for(tool, input, listing));
  std::string text;
  std::array<std::uint8_t, 1 << 16> part{};
  while (const std::size_t count =
             read_fully(conversion.stream.number(), part, "hiac-convert --list"))
    text.append(reinterpret_cast<const char*>(part.data()), count);
  finish(conversion, input.path);
  const auto facts = nlohmann::json::parse(text);
  return std::max<std::size_t>(facts.at("inventory").at("times").size(), 1);
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  bool inside = false;
  char quote = '\0';
  for (const char c : text) {
    if (quote != '\0') {
      if (c == quote)
        quote = '\0';
      else
        words.back() += c;
      continue;
    }
    if (c == ' ' || c == '\t' || c == '\n') {
      inside = false;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    if (c == '\'' || c == '"')
      quote = c;
    else
      words.back() += c;
  }
  if (quote != '\0') throw UsageError(fmt::format("a quote is not closed in `{}`", text));
  return words;
}

}  // namespace hiac::tools
