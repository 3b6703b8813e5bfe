// hiac: one name for all commands, each of which is a program of its own: hiac NAME runs hiac-NAME.

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "hiac/base/version.hpp"
#include "tools/common/sibling_program.hpp"
#include "tools/common/suggestion.hpp"

namespace {

using hiac::tools::become;
using hiac::tools::likely_meant;
using hiac::tools::places_of;
using hiac::tools::pointers_to;

constexpr int kUsage = 2, kInternal = 4;

struct Command {
  std::string_view name, meaning;
};

constexpr std::array kCommands{
    Command{"picture", "a picture of a file: hiac picture run.inp makes run.png"},
    Command{"convert", "foreign finite-element files to zoo meshes, and back"},
    Command{"info", "what a mesh, an order or an image holds; a first view of a mesh"},
    Command{"check", "whether a mesh is valid, and its defects"},
    Command{"tetrahedralize", "tetrahedra of surfaces, points and cells"},
    Command{"sort", "the visibility order of a mesh's cells"},
    Command{"render", "a picture of a mesh, with all options"},
    Command{"preview", "a picture by graphics hardware"},
    Command{"view", "a window in which views and transfer functions are set"},
    Command{"compare", "how much two images differ"},
    Command{"help", "this text, or that of a command: hiac help convert"}};

std::string usage() {
  std::string text = "hiac COMMAND [options] runs the program hiac-COMMAND. The commands:\n\n";
  for (const Command& command : kCommands)
    text += "  " + std::string(command.name) + std::string(16 - command.name.size(), ' ') +
            std::string(command.meaning) + "\n";
  return text + "\nhiac COMMAND --help tells a command's options.\n";
}

// Becomes hiac-NAME; returns an exit code where there is no such program.
int run(const std::string& name, std::vector<std::string> arguments) {
  const std::string program = "hiac-" + name;
  arguments.insert(arguments.begin(), program);
  std::vector<char*> pointers = pointers_to(arguments);
  become(places_of(program), pointers);
  std::vector<std::string> known;
  for (const Command& command : kCommands) known.emplace_back(command.name);
  for (const Command& command : kCommands)
    if (command.name == name) {
      std::cerr << "hiac: " << program << " is neither beside hiac nor on PATH ("
                << std::strerror(errno) << ")\n";
      return kInternal;
    }
  const std::string meant = likely_meant(name, known);
  std::cerr << "hiac: no such command: " << name
            << (meant.empty() ? "" : " (did you mean " + meant + "?)") << " (see hiac help)\n";
  return kUsage;
}

// Whether the arguments say where the picture goes, or that there is none.
bool has_output(const std::vector<std::string>& arguments) {
  for (const std::string_view word : arguments)
    if (word.starts_with("-o") || word == "--output" || word.starts_with("--output=") ||
        word == "--pixel" || word.starts_with("--pixel="))
      return true;
  return false;
}

// hiac-render with the picture beside the other files of the working folder, named after FILE.
int make_picture(std::vector<std::string> arguments) {
  if (arguments.empty()) {
    std::cerr << "hiac: picture: no FILE (hiac picture FILE [-o PICTURE] [options of hiac-render] "
                 "expected)\n";
    return kUsage;
  }
  if (!arguments.front().starts_with('-') && !has_output(arguments)) {
    const std::filesystem::path file(arguments.front());
    const auto name = file.has_filename() ? file : file.parent_path();
    const std::string picture = name.stem().string() + ".png";
    std::cerr << "hiac: the picture is " << picture << '\n';
    arguments.insert(arguments.end(), {"-o", picture});
  }
  return run("render", std::move(arguments));
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + (argc > 0 ? 1 : 0), argv + argc);
  if (words.empty()) {
    std::cerr << usage();
    return kUsage;
  }
  const std::string& name = words.front();
  const std::vector<std::string> rest(words.begin() + 1, words.end());
  if (name == "--version") {
    std::cout << "hiac " HIAC_VERSION "\n";
    return 0;
  }
  if (name == "help" && !rest.empty()) return run(rest.front(), {"--help"});
  if (name == "help" || name == "--help" || name == "-h") {
    std::cout << usage();
    return 0;
  }
  return name == "picture" ? make_picture(rest) : run(name, rest);
}
