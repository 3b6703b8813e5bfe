#include "hiac/render/draw_cells.hpp"

#include "hiac/render/cells/general_cells.hpp"
#include "hiac/render/tetrahedra/higher_order_kernel.hpp"
#include "hiac/render/tetrahedra/tetrahedron_kernel.hpp"

namespace hiac {

DrawCells draw_for(const Frame& frame, CellId cell) {
  switch (frame.kernel_cells[cell]) {
    case CellKernel::linear:
      return render_tetrahedra;
    case CellKernel::quadratic:
      return for_higher_order_kernel(frame, cell) ? render_quadratic_tetrahedra
                                                  : render_general_cells;
    case CellKernel::cubic:
      return for_higher_order_kernel(frame, cell) ? render_cubic_tetrahedra : render_general_cells;
    case CellKernel::none_planar:
    case CellKernel::none_curved:
      break;
  }
  return render_general_cells;
}

}  // namespace hiac
