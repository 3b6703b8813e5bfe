#pragma once

#include <nlohmann/json.hpp>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/scene/scene.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// Says what a user needs to choose extinctions: the fields' ranges and the mesh's size.
/// `one_of_many`: the picture is one of several, of each of which this is said with --verbose
/// alone.
void note_model(Tool& tool, bool one_of_many, const ZooMesh& mesh, const Scene& scene);

/// Says what making a picture took and met, and returns it as facts.
nlohmann::ordered_json note_work(Tool& tool, bool one_of_many, const RenderStatistics& statistics);

}  // namespace hiac::tools
