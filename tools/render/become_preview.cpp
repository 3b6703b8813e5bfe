#include "tools/render/become_preview.hpp"

#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "hiac/base/error.hpp"
#include "tools/common/sibling_program.hpp"

namespace hiac::tools {
namespace {

constexpr const char* kProgram = "hiac-preview";

// The arguments without `--engine preview`; empty where that is not among them.
std::vector<std::string> without_engine(int argc, char** argv) {
  std::vector<std::string> kept{kProgram};
  bool asked = false;
  for (int k = 1; k < argc; ++k) {
    const std::string_view argument(argv[k]);
    if (argument == "--engine=preview") {
      asked = true;
    } else if (argument == "--engine" && k + 1 < argc &&
               std::string_view(argv[k + 1]) == "preview") {
      asked = true;
      ++k;
    } else {
      kept.emplace_back(argument);
    }
  }
  if (!asked) kept.clear();
  return kept;
}

}  // namespace

std::optional<int> become_preview(int argc, char** argv) {
  std::vector<std::string> arguments = without_engine(argc, argv);
  if (arguments.empty()) return std::nullopt;
  std::vector<char*> pointers = pointers_to(arguments);
  become(places_of(kProgram), pointers);
  std::cerr << "hiac-render: --engine preview: the program hiac-preview is neither beside "
               "hiac-render nor on PATH (it is built where libegl-dev and libepoxy-dev are "
               "installed)\n";
  return static_cast<int>(ExitCode::internal);
}

}  // namespace hiac::tools
