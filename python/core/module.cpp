// hiac._core: what the package hiac is made of. Arrays are shared, not copied; work runs without
// the GIL.
#include <pybind11/pybind11.h>

#include "python/core/compare.hpp"
#include "python/core/drawing.hpp"
#include "python/core/errors.hpp"
#include "python/core/mesh.hpp"
#include "python/core/order.hpp"
#include "python/core/picture.hpp"
#include "python/core/saving.hpp"
#include "python/core/scene.hpp"
#include "python/core/tetrahedralize.hpp"
#include "python/core/work.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace hiac::python;
  module.attr("version") = HIAC_VERSION;
  register_errors();
  bind_work(module);
  bind_mesh(module);
  bind_scene(module);
  bind_saving(module);
  bind_order(module);
  bind_picture(module);
  bind_drawing(module);
  bind_compare(module);
  bind_tetrahedralize(module);
}
