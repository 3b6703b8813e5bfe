#pragma once

#include <QString>
#include <optional>

#include "tools/view/viewport/painter.hpp"

namespace hiac::view {

/// What the status line says of a picture: the engine, how many pixels were computed, the claimed
/// error, the seconds, and what the witness counted. `error`: once it was looked for; its value is
/// none where no bound is claimed. `scale`: pixels of the screen for one of the picture.
QString picture_facts(const Painted& picture, const std::optional<std::optional<double>>& error,
                      double scale);

}  // namespace hiac::view
