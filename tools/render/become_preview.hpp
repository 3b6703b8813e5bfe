#pragma once

#include <optional>

namespace hiac::tools {

/// Where the arguments ask for --engine preview, replaces this program by hiac-preview, from the
/// folder that it is in or else from PATH, with the other arguments: the accurate engine's program
/// links and loads no OpenGL. Returns nothing where they do not ask, and the exit code, after a
/// line on stderr, where there is no such program.
std::optional<int> become_preview(int argc, char** argv);

}  // namespace hiac::tools
