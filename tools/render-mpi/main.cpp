// hiac-render-mpi: a picture of a mesh, by many processes.

#include <chrono>
#include <memory>
#include <thread>

#include "hiac/cluster/mpi/mpi_communicator.hpp"
#include "hiac/cluster/shared_tiles.hpp"
#include "tools/common/render/render_command.hpp"
#include "tools/render-mpi/held_output.hpp"
#include "tools/render-mpi/parted_pictures.hpp"

namespace {

using namespace hiac;
using namespace hiac::tools;

int run(Communicator& all, int argc, char** argv) {
  Tool tool("hiac-render-mpi", "Makes a volume-rendered picture of a mesh by many processes.",
            "  mpirun -n 8 hiac-render-mpi part.zoo --view view.toml -o part.png\n"
            "  mpirun -n 8 hiac-render-mpi part.zparts --view view.toml -o part.exr");
  const SharedTiles crew(all);
  return render_command(tool, argc, argv,
                        {.all = &all,
                         .crew = &crew,
                         .writes = all.rank() == 0,
                         .draw_parts = [&](Tool& of, RenderOptions& options) {
                           draw_parted_pictures(all, of, options);
                         }});
}

}  // namespace

int main(int argc, char** argv) {
  MpiCommunicator all(argc, argv);
  // of errors that all processes meet, one is told
  const auto held = all.rank() == 0 ? nullptr : std::make_unique<HeldOutput>();
  const int exit_code = run(all, argc, argv);
  if (exit_code == 0) {
    gather(all, {});  // none is done before the picture is written
    return 0;
  }
  if (held) held->tell_after_a_while();
  // whoever has started the processes passes on what they wrote, unless they end at once
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  MpiCommunicator::abort(exit_code);
}
