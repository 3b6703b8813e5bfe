#pragma once

#include <string>

#include <toml++/toml.h>

#include "hiac/scene/toml/spec_value.hpp"

namespace hiac {

/// Applies KEY=VALUE to a specification's table: replaces the value, adds it, or (empty VALUE)
/// removes the key. Throws UsageError with the option if it is malformed or its path leads below a
/// plain value or to an element that a list does not have.
AppliedOverride apply_override(toml::table& document, const std::string& option);

}  // namespace hiac
