#include "hiac/scene/toml/spec_text.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/toml/text_layout.hpp"

namespace hiac {
namespace {

/// Rejects deeply dotted keys: the parser recurses over their parts without a limit, and could
/// exhaust the stack.
void refuse_deep_keys(std::string_view text, const std::string& subject) {
  constexpr std::size_t kMaxParts = 32;
  constexpr std::string_view kEndsRun = "=,{}[]\n";
  std::size_t dots = 0;
  std::size_t line = 1;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    std::size_t next = i + 1;
    if (c == '"' || c == '\'') next = skip_string(text, i);
    if (c == '#') next = std::min(text.find('\n', i), text.size());
    if (kEndsRun.find(c) != std::string_view::npos) dots = 0;
    if (c == '.' && ++dots == kMaxParts)
      throw InputError(fmt::format("{}:{}", subject, line),
                       fmt::format("a key of more than {} parts", kMaxParts));
    next = std::min(next, text.size());
    line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                                text.begin() + static_cast<std::ptrdiff_t>(next),
                                                '\n'));
    i = next;
  }
}

}  // namespace

std::string in_one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

std::string read_text_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) throw InputError(path, std::string("cannot be opened: ") + std::strerror(errno));
  std::string text;
  std::array<char, 65536> block{};
  while (const std::size_t got = std::fread(block.data(), 1, block.size(), file.get())) {
    text.append(block.data(), got);
    if (text.size() > kMaxTextBytes)
      throw InputError(path, fmt::format("too large for a text file of this kind (expected at "
                                         "most {} bytes)",
                                         kMaxTextBytes));
  }
  if (std::ferror(file.get()) != 0)
    throw InputError(path, std::string("cannot be read: ") + std::strerror(errno));
  return text;
}

toml::table parse_toml(std::string_view text, const std::string& subject) {
  refuse_deep_keys(text, subject);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}", subject, error.source().begin.line),
                     in_one_line(std::string(error.description())));
  }
}

}  // namespace hiac
