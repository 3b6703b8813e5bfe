#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "hiac/image/alignment.hpp"
#include "hiac/image/difference.hpp"
#include "hiac/image/image.hpp"

namespace hiac::tools {

/// What is known of two images of one size.
struct Comparison {
  std::vector<Difference> channels;  ///< at least one
  std::optional<double> psnr, ssim, mean_flip, largest_flip;
  std::optional<Image> flip;
  bool equal = false;  ///< the same channels with the same values
};

/// Throws JudgementError, with both names, if the images have no channel in common.
Comparison compare_images(const Image& image, const std::string& name, const Image& reference,
                          const std::string& reference_name);

/// The comparison for programs; what is infinite or not defined is null there.
void put_into(nlohmann::ordered_json& facts, const Comparison& comparison);
void put_into(nlohmann::ordered_json& facts, const Misfit& misfit);

/// The comparison for people: whole lines.
std::string table(const Comparison& comparison);

/// A line for everything that is wrong with the picture as a whole; none where nothing is.
std::vector<std::string> lines_of(const Misfit& misfit);

}  // namespace hiac::tools
