#include "tools/common/picture/starter_command.hpp"

#include <fmt/format.h>

#include "tools/common/as_option.hpp"

namespace hiac::tools {

void add_starter_options(CLI::App& app, StarterOptions& options) {
  app.add_option("--field", options.field,
                 "The starter view shows this field, as pressure or velocity:x (default: the field "
                 "that says most)")
      ->type_name("NAME");
  app.add_option("--preset", options.preset,
                 "The starter view has this colour map, as \"cool to warm\" (default: viridis)")
      ->type_name("NAME");
  app.add_option("--isovalues", options.isovalues,
                 "The starter view has N isosurfaces, evenly over the field's range")
      ->check(CLI::Range(0U, 100U))
      ->type_name("N");
  app.add_flag("--dark", options.dark, "The starter view has a dark background, not a white one");
}

bool are_given(const StarterOptions& options) {
  const StarterOptions none;
  return !options.field.empty() || options.preset != none.preset || options.isovalues > 0 ||
         options.dark;
}

StarterView make_view(Tool& tool, const ZooMesh& mesh, const std::string& subject,
                      const StarterOptions& options) {
  StarterView view = tool.timed("view", [&] {
    return as_option("--", [&] { return make_starter_view(mesh, subject, options); });
  });
  for (const std::string& line : view.notes) tool.note(line);
  tool.facts()["field"] = view.scene.volume.color->field;
  return view;
}

std::string file_text(const StarterView& view, const std::string& subject) {
  return fmt::format("# A first view of {}: a start to change from.\n\n{}", subject, view.text);
}

}  // namespace hiac::tools
