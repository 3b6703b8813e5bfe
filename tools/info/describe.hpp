#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/order/order_file.hpp"

namespace hiac::tools {

/// What a file holds: for programs, and as lines for people.
struct Description {  // NOLINT(bugprone-exception-escape): the JSON library's move says so
  nlohmann::ordered_json facts;
  std::string text;
};

/// A line of a description's text.
std::string description_line(std::string_view label, const std::string& value);

/// A mesh, and the orders behind it where the container has any. `subject` stands for the file.
Description describe_mesh(const ZooFile& file, const std::string& subject);

/// The orders of an order file, one or several.
Description describe_orders(const std::vector<ExtraChunk>& chunks, const std::string& subject);

Description describe_image(const ImageFile& file, const std::string& subject);

}  // namespace hiac::tools
