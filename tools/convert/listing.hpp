#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "formats/common/mesh/format.hpp"

namespace hiac::tools {

/// The table of --list-formats.
std::string formats_table();

/// What --list prints of a file.
std::string inventory_text(const formats::Inventory& inventory);

/// The same for --json.
nlohmann::ordered_json inventory_facts(const formats::Inventory& inventory);

}  // namespace hiac::tools
