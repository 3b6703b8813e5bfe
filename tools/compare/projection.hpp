#pragma once

#include <functional>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "hiac/image/alignment.hpp"
#include "hiac/image/image.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::tools {

/// Draws the truth of another camera in another size, with n x n rays a pixel.
using DrawTruth = std::function<Image(const Camera& camera, ImageSize size, std::uint32_t samples)>;

/// A camera that explains a picture better than that of the view.
struct ProjectionFit {
  Camera camera;
  Misfit misfit;  ///< of the picture from the truth of this camera
};

/// Looks for another projection of the same view: parallel for perspective or the other way,
/// another view angle or height, with the eye in its place or moved along the view direction so
/// that what is at look_at keeps its size. Small pictures decide (the longer side has 96 pixels at
/// most), and one of the full size confirms: it has to leave half at most of the difference that
/// `misfit`, that of the view, leaves. Nothing is looked for where that is as small as 8 bits make
/// it.
std::optional<ProjectionFit> find_projection(const Camera& view, const Image& picture,
                                             const Misfit& misfit, const DrawTruth& draw);

/// What is said of it.
std::string line_of(const Camera& view, const ProjectionFit& fit, double rmse);

/// Adds `projection` to the facts' `misfit`, whose rmse becomes that of the picture as it is.
void put_into(nlohmann::ordered_json& facts, const ProjectionFit& fit, double rmse);

}  // namespace hiac::tools
