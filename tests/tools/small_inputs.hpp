#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace hiac::test {

/// An input of a tool: a sound file, and the command that reads it, in which %s stands for its name
/// (in `view-%s`: for that of a view whose colours it is; a channel of a .f32 picture is damaged
/// under the name that the command has).
struct SmallInput {
  std::string name, command;
};

/// Every kind of input of one tool, and what else it reads besides.
struct ToolInputs {
  std::string tool;
  std::vector<SmallInput> inputs;

  friend std::ostream& operator<<(std::ostream& out, const ToolInputs& of) {
    return out << of.tool;
  }
};

/// Of every tool that this build has, but for the foreign formats of hiac-convert.
std::vector<ToolInputs> inputs_of_tools();

/// Writes the sound files into a folder. Returns what went wrong: nothing, or a tool's message.
std::string write_small_inputs(const std::filesystem::path& folder);

}  // namespace hiac::test
