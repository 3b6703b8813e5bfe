#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "hiac/mesh/zoo_container.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// The mesh that a tool reads.
struct MeshInput {
  std::string path;  ///< a zoo mesh, or a file that hiac-convert reads; "-" or empty: stdin
  /// Further options of hiac-convert, as words with blanks between; quotes keep a word together.
  std::string conversion;
  bool is_silent = false;  ///< nothing is said of the conversion, unless it fails
  /// Cells of a foreign file that the zoo has no kind for are approximated, and hiac-convert says
  /// by what and how well, unless `conversion` says what becomes of them.
  bool may_approximate = false;
};

/// Adds the option --convert.
void add_conversion(CLI::App& app, std::string& conversion);

/// How --help describes the argument MESH.
inline constexpr const char* kMeshHelp =
    "Zoo mesh, or any file that hiac-convert reads; - or none: a zoo mesh from stdin";

/// Whether a path names a folder, or a regular file that is no zoo container and none of our other
/// files, for which it throws InputError.
bool is_foreign_mesh(const std::string& path);

/// Reads a zoo mesh, or lets hiac-convert, beside this tool, read a foreign file through a pipe,
/// and says so in a line. hiac-convert prints its own messages; where it fails, so does this, with
/// its exit code. Throws UsageError when there is nothing to read, InputError when it is malformed.
/// `further`: options of hiac-convert that the tool itself adds.
ZooFile read_any_mesh(const Tool& tool, const MeshInput& input,
                      MeshNumbers numbers = MeshNumbers::checked,
                      const std::vector<std::string>& further = {});

/// How many time steps a foreign file has, as hiac-convert --list says; one if it knows no time.
/// Throws as read_any_mesh does.
std::size_t step_count(const Tool& tool, const MeshInput& input,
                       const std::vector<std::string>& further = {});

/// The words of a text, as a shell would take them apart: blanks separate, quotes of both kinds
/// keep together. Throws UsageError for a quote that is not closed.
std::vector<std::string> words_of(const std::string& text);

}  // namespace hiac::tools
