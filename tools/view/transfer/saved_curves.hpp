#pragma once

#include <string>

#include "hiac/scene/scene.hpp"

namespace hiac::view {

/// A file of both transfer functions: the tables [volume.color] and [volume.extinction] of a
/// specification, with their keys as the text has them. A colour map from a file becomes points, so
/// that the file needs no other. Throws UsageError if the text has neither table.
std::string saved_curves(const std::string& text, const Scene& scene);

/// The text with the tables of such a file instead of its own; one that the file lacks stays.
/// `subject` names the file in messages. Throws InputError if it has neither table.
std::string with_saved_curves(std::string text, const std::string& saved,
                              const std::string& subject);

}  // namespace hiac::view
