#pragma once

#include <pybind11/pybind11.h>

#include "hiac/render/explain_pixel.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::python {

/// What is known of a pixel, under the names that hiac-render --pixel --json gives it.
pybind11::dict pixel_facts(const PixelExplanation& pixel, const Scene& scene);

}  // namespace hiac::python
