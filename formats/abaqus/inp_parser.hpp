#pragma once

#include <string>

#include "formats/abaqus/inp_model.hpp"

namespace hiac::formats::abaqus {

/// Reads the deck and the files that it includes. Throws InputError naming file and line.
Model parse_deck(const std::string& path);

}  // namespace hiac::formats::abaqus
