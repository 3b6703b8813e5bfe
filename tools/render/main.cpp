// hiac-render: a picture of a mesh.

#include <optional>

#include "tools/common/render/render_command.hpp"
#include "tools/render/become_preview.hpp"

int main(int argc, char** argv) {
  using hiac::tools::Tool;
  if (const std::optional<int> failed = hiac::tools::become_preview(argc, argv)) return *failed;
  Tool tool(
      "hiac-render", "Makes a volume-rendered picture of a mesh.",
      "  hiac-render run.inp -o run.png   # any file that hiac-convert reads, and a starter view\n"
      "  hiac-render run.exo --convert '--step 3' --field stress --save-view run.toml -o run.png\n"
      "  hiac-render part.zoo --view view.toml -o part.png\n"
      "  hiac-render part.zoo --view view.toml --order part.order --size 2048x1536 -o part.exr\n"
      "  hiac-render part.zoo --view view.toml --set camera.fov=20 -o part.npy\n"
      "  hiac-render part.zoo --view view.toml --channels depth,error -o part.exr\n"
      "  hiac-render part.zoo --view view.toml --crop 300,200,64,64 -o detail.npy\n"
      "  hiac-render part.zoo --view view.toml --pixel 300,200\n"
      "  hiac-render part.zoo --view view.toml --samples 8 --filter bspline -o truth.exr\n"
      "  hiac-render part.zoo --view view.toml --set render.splat_below=2 -o splatted.exr\n"
      "  hiac-render near.zoo --view view.toml --under far.exr -o both.exr\n"
      "  hiac-render part.zoo --view view.toml --set annotation.colorbar.show=true -o part.png\n"
      "  hiac-render part.zoo --view view.toml --colorbar bar.png\n"
      "  hiac-render part.zoo --view turntable.toml --frames -o part-%04d.png\n"
      "  hiac-render run.exo --steps all --view view.toml -o run-%04d.png\n"
      "  hiac-render run-%04d.zoo --view view.toml --fps 12 -o run.mp4   # by ffmpeg\n"
      "  hiac-render part.zoo --view view.toml --threshold stress=100, -o part.png\n"
      "  hiac-render part.zoo --view view.toml --engine preview -o quick.png");
  return hiac::tools::render_command(tool, argc, argv, {});
}
