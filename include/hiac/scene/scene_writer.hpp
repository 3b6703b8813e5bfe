#pragma once

#include <string>

#include "hiac/scene/annotation.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

enum class Comments : bool { none, explain };

/// Returns the specification as TOML text: complete and self-contained (colour maps as points),
/// with numbers exact to the last bit, so that parsing it gives an equal scene. With
/// `Comments::explain`, a short comment explains every key.
std::string to_toml(const Scene& scene, Comments comments = Comments::none);

/// The same with an annotation, whose table is left out if it has the defaults alone.
std::string to_toml(const Scene& scene, const Annotation& annotation,
                    Comments comments = Comments::none);

}  // namespace hiac
