#include "tools/common/render/color_bar_file.hpp"

#include "hiac/annotate/annotation_facts.hpp"
#include "hiac/annotate/color_bar.hpp"
#include "hiac/annotate/ticks.hpp"
#include "hiac/image/image_io.hpp"
#include "tools/common/as_option.hpp"

namespace hiac::tools {

bool writes_color_bar(const RenderOptions& options) {
  return options.role->writes && !options.color_bar.empty();
}

void write_color_bar(Tool& tool, const RenderOptions& options, const ZooMesh& mesh, double diagonal,
                     const ParsedScene& view) {
  const Volume& volume = view.scene.volume;
  const double round_length = diagonal > 0 ? round_below(diagonal / 10) : 1;
  const double length = options.color_bar_length > 0 ? options.color_bar_length : round_length;
  const ColorBarLabels labels{volume.color ? field_label(mesh, volume.color->field) : "",
                              volume.extinction ? field_label(mesh, volume.extinction->field) : ""};
  const bool logarithmic = view.annotation.bar_is_logarithmic;
  write_image(options.color_bar, as_option("--colorbar: ", [&] {
                return with_names(
                    options, [&] { return draw_color_bar(volume, labels, length, logarithmic); });
              }));
  tool.facts()["color_bar_length"] = length;
}

}  // namespace hiac::tools
