#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/scene/scene.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

// What a user needs to choose extinctions, and how long a picture took. `one_of_many`: the picture
// is one of several, of each of which this is said with --verbose alone; so is what concerns a
// medium that an opaque skin hides.

/// Says the fields' ranges and the mesh's size.
void note_model(Tool& tool, bool one_of_many, const ZooMesh& mesh, const Scene& scene);

/// Says what making a picture of the scene took and met, and returns it as facts.
nlohmann::ordered_json note_work(Tool& tool, bool one_of_many, const Scene& scene,
                                 const RenderStatistics& statistics);

/// With --strict, what is otherwise told leaves no picture behind: throws JudgementError if
/// segments of the picture that `path` names were met out of order.
void require_truth(const std::string& path, const RenderStatistics& statistics);

}  // namespace hiac::tools
