#include "tools/view/window/shell_command.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>

namespace hiac::view {

std::string shell_word(const std::string& word) {
  const bool is_plain = !word.empty() && std::ranges::all_of(word, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./:=,+@%").find(c) != std::string_view::npos;
  });
  if (is_plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_command(const tools::PictureCommand& command, const std::string& view,
                          std::optional<std::uint32_t> frame, std::uint32_t samples,
                          bool skips_invalid) {
  const auto absolute = [](const std::string& path) {
    return shell_word(std::filesystem::absolute(path).lexically_normal().string());
  };
  std::string line =
      fmt::format("hiac-render {} --view {}", absolute(command.input), absolute(view));
  if (!command.conversion.empty()) line += " --convert " + shell_word(command.conversion);
  if (!command.block.empty()) line += " --block " + shell_word(command.block);
  if (!command.threshold.empty()) line += " --threshold " + shell_word(command.threshold);
  if (frame) line += fmt::format(" --frame {}", *frame);
  if (samples > 1) line += fmt::format(" --samples {}", samples);
  if (skips_invalid) line += " --skip-invalid";
  return line + " -o picture.png";
}

}  // namespace hiac::view
