#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "hiac/session/starter_view.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// Adds --field, --preset, --isovalues and --dark, which say what a starter view shows.
void add_starter_options(CLI::App& app, StarterOptions& options);

/// Whether any of them was given.
bool are_given(const StarterOptions& options);

/// Makes the starter view of a mesh, and notes what it shows. `subject`: the mesh's name.
StarterView make_view(Tool& tool, const ZooMesh& mesh, const std::string& subject,
                      const StarterOptions& options);

/// The view as a file.
std::string file_text(const StarterView& view, const std::string& subject);

}  // namespace hiac::tools
