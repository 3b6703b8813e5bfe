#include "tools/view/transfer/saved_curves.hpp"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/colormaps/built_in_colormaps.hpp"
#include "hiac/scene/toml/edited_text.hpp"
#include "hiac/scene/toml/spec_text.hpp"
#include "hiac/scene/toml/text_layout.hpp"
#include "tools/view/transfer/transfer_text.hpp"

namespace hiac::view {
namespace {

constexpr const char* kTables[] = {"color", "extinction"};

using Keys = std::vector<std::pair<std::string, std::string>>;

/// The keys of [volume.NAME], as written; none if there is no such table.
Keys keys_of(const std::string& text, const std::string& name) {
  Keys keys;
  const SpecPath table{"volume", name};
  for (const TextSection& section : sections_of(text))
    for (const KeyLine& line : section.keys) {
      SpecPath path = section.path;
      path.insert(path.end(), line.key.begin(), line.key.end());
      if (path == table) {
        for (const TextElement& element : elements_of(text, line.value.begin))
          keys.emplace_back(element.key.back(), element.value.of(text));
      } else if (path.size() == 3 && path[0] == table[0] && path[1] == table[1]) {
        keys.emplace_back(path[2], line.value.of(text));
      }
    }
  return keys;
}

}  // namespace

std::string saved_curves(const std::string& text, const Scene& scene) {
  const std::string preset = preset_of(text);
  const bool is_file = !preset.empty() && !built_in_colormap(preset);
  const std::string saved = is_file ? with_plain_points<3>(text, scene) : text;
  std::string file;
  for (const char* name : kTables)
    if (const Keys keys = keys_of(saved, name); !keys.empty())
      file = with_table(file, fmt::format("volume.{}", name), keys);
  if (file.empty()) throw UsageError("transfer functions: the view has none");
  return file;
}

std::string with_saved_curves(std::string text, const std::string& saved,
                              const std::string& subject) {
  parse_toml(saved, subject);
  bool has_any = false;
  for (const char* name : kTables) {
    const Keys keys = keys_of(saved, name);
    if (keys.empty()) continue;
    has_any = true;
    const std::string table = fmt::format("volume.{}", name);
    text = with_table(without_table(text, table), table, keys);
  }
  if (!has_any)
    throw InputError(subject,
                     "no transfer functions (expected [volume.color] or "
                     "[volume.extinction], found neither)");
  return text;
}

}  // namespace hiac::view
