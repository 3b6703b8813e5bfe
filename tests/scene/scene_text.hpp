#pragma once

#include <string>

namespace hiac {

/// The least that a specification must hold, on lines 1 to 9.
inline const std::string kLeast =
    "[image]\n"
    "width = 4\n"
    "height = 3\n"
    "[camera]\n"
    "eye = [0, -3, 1]\n"
    "look_at = [0, 0, 0]\n"
    "up = [0, 0, 1]\n"
    "fov = 30\n"
    "# line 9\n";

}  // namespace hiac
