#include "tools/info/describe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/finite_range.hpp"
#include "hiac/geometry/box.hpp"
#include "hiac/mesh/fields/location_name.hpp"
#include "hiac/mesh/mesh_hash.hpp"

namespace hiac::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const FiniteRange& range) {
  std::string text =
      range.empty() ? "no finite value" : fmt::format("{:g} to {:g}", range.low, range.high);
  if (range.not_finite > 0) text += fmt::format(", {} not finite", range.not_finite);
  return text;
}

void put(const FiniteRange& range, Json& facts) {
  facts["minimum"] = range.empty() ? Json() : Json(range.low);
  facts["maximum"] = range.empty() ? Json() : Json(range.high);
  facts["not_finite"] = range.not_finite;
}

void describe_cells(const ZooMesh& mesh, Description& description) {
  std::array<std::uint64_t, kKindCount> counts{};
  for (const CellKind kind : mesh.kinds) ++counts[static_cast<std::size_t>(kind)];
  Json kinds = Json::object();
  std::string text;
  for (std::size_t k = 0; k < kKindCount; ++k) {
    if (counts[k] == 0) continue;
    const std::string name(kind_name(static_cast<CellKind>(k)));
    kinds[name] = counts[k];
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[k], name);
  }
  description.facts["cells"] = mesh.cell_count();
  description.facts["nodes"] = mesh.node_count();
  description.facts["kinds"] = kinds;
  description.text += description_line("cells", fmt::format("{} ({})", mesh.cell_count(), text));
  description.text += description_line("nodes", fmt::format("{}", mesh.node_count()));
}

void describe_bounds(const ZooMesh& mesh, Description& description) {
  if (mesh.node_count() == 0) return;
  const Box box = box_of_nodes(mesh);
  Json facts = Json::array();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    facts.push_back({box.low[axis], box.high[axis]});
    description.text += description_line(
        axis == 0 ? "bounds" : "",
        fmt::format("{} {:g} to {:g}", "xyz"[axis], box.low[axis], box.high[axis]));
  }
  description.facts["bounds"] = facts;
  const double diagonal = box.diagonal();
  description.facts["diagonal"] = diagonal;
  description.text += description_line("diagonal", fmt::format("{:g}", diagonal));
}

/// The range of a scalar field, or of the lengths of a vector field.
FiniteRange field_range(const Field& field) {
  FiniteRange range;
  const auto values = field.values.view();
  for (std::size_t i = 0; i < values.size(); i += field.components) {
    double length = values[i];
    if (field.components > 1) length = std::fabs(length);
    for (std::size_t c = 1; c < field.components; ++c) length = std::hypot(length, values[i + c]);
    range.include(length);
  }
  return range;
}

void describe_fields(const ZooMesh& mesh, Description& description) {
  description.facts["fields"] = Json::array();
  for (const Field& field : mesh.fields) {
    const FiniteRange range = field_range(field);
    Json facts{{"name", field.name},
               {"unit", field.unit},
               {"location", location_name(field.location)},
               {"components", field.components}};
    put(range, facts);
    description.facts["fields"].push_back(facts);
    const bool first = &field == &mesh.fields.front();
    const std::string unit = field.unit.empty() ? "" : " " + field.unit;
    description.text += description_line(
        first ? "fields" : "",
        fmt::format(
            "{} ({}, {}): {}{}{}", field.name, location_name(field.location),
            field.components == 1 ? "scalar" : fmt::format("{} components", field.components),
            field.components == 1 ? "" : "magnitude ", text_of(range), unit));
  }
  if (mesh.fields.empty()) description.text += description_line("fields", "none");
}

// The facts of one order; its lines are added to `text`.
Json describe_order(const OrderRecord& record, std::string& text) {
  std::uint64_t in_groups = 0;
  std::uint32_t largest = 1;
  for (const CellGroup& group : record.order.groups) {
    in_groups += group.count;
    largest = std::max(largest, group.count);
  }
  text += description_line(
      "order",
      fmt::format("{} cells by {}; {}", record.order.cells.size(), record.order.algorithm,
                  in_groups == 0 ? "no groups"
                                 : fmt::format("{} groups of {} cells together, {} in the "
                                               "largest",
                                               record.order.groups.size(), in_groups, largest)));
  text += description_line("for geometry", record.mesh_hash);
  text += description_line("for view", record.view_hash);
  return {{"algorithm", record.order.algorithm},
          {"cells", record.order.cells.size()},
          {"groups", record.order.groups.size()},
          {"cells_in_groups", in_groups},
          {"largest_group", largest},
          {"mesh_hash", record.mesh_hash},
          {"view_hash", record.view_hash}};
}

// One order is a fact of its own, several are a list.
void add_orders(const std::vector<ExtraChunk>& chunks, const std::string& subject,
                Description& description) {
  Json list = Json::array();
  for (const ExtraChunk& chunk : chunks)
    list.push_back(describe_order(decode_order(chunk, subject), description.text));
  if (list.size() == 1)
    description.facts["order"] = list.front();
  else if (!list.empty())
    description.facts["orders"] = std::move(list);
}

}  // namespace

std::string description_line(std::string_view label, const std::string& value) {
  return fmt::format("  {:<12} {}\n", label, value);
}

Description describe_mesh(const ZooFile& file, const std::string& subject) {
  const ZooMesh& mesh = file.mesh;
  Description description;
  description.facts["holds"] = "mesh";
  description.text = subject + ": zoo mesh\n";
  describe_cells(mesh, description);
  describe_bounds(mesh, description);
  describe_fields(mesh, description);
  const std::string hash = content_hash(mesh);
  description.facts["mesh_hash"] = hash;
  const std::string geometry = geometry_hash(mesh);
  description.facts["geometry_hash"] = geometry;
  description.facts["face_adjacency"] = mesh.adjacency.has_value();
  description.facts["metadata"] = Json::object();
  description.text += description_line("hash", hash);
  description.text += description_line("geometry", geometry);
  description.text += description_line("adjacency", mesh.adjacency ? "stored" : "not stored");
  for (const auto& [key, value] : mesh.metadata) {
    description.facts["metadata"][key] = value;
    description.text += description_line("metadata", fmt::format("{}: {}", key, value));
  }
  std::vector<ExtraChunk> orders;
  for (const ExtraChunk& chunk : file.extras) {
    if (chunk.type == kOrderChunk)
      orders.push_back(chunk);
    else
      description.text += description_line(
          "chunk", fmt::format("{} ({} bytes, not known here)", chunk.type, chunk.payload.size()));
  }
  add_orders(orders, subject, description);
  return description;
}

Description describe_orders(const std::vector<ExtraChunk>& chunks, const std::string& subject) {
  Description description;
  description.facts["holds"] = "order";
  description.text =
      fmt::format("{}: visibility order{}\n", subject,
                  chunks.size() == 1 ? "" : fmt::format("s of {} views", chunks.size()));
  add_orders(chunks, subject, description);
  return description;
}

Description describe_image(const ImageFile& file, const std::string& subject) {
  const Image& image = file.image;
  Description description;
  description.facts["holds"] = "image";
  description.facts["width"] = image.width();
  description.facts["height"] = image.height();
  description.text = subject + ": image\n";
  description.text +=
      description_line("size", fmt::format("{} x {} pixels", image.width(), image.height()));
  description.facts["channels"] = Json::array();
  for (std::size_t c = 0; c < image.channel_count(); ++c) {
    FiniteRange range;
    for (std::size_t i = c; i < image.values().size(); i += image.channel_count())
      range.include(image.values()[i]);
    Json facts{{"name", image.channels()[c]}};
    put(range, facts);
    description.facts["channels"].push_back(facts);
    description.text += description_line(
        c == 0 ? "channels" : "", fmt::format("{}: {}", image.channels()[c], text_of(range)));
  }
  description.facts["attributes"] = Json::object();
  for (const auto& [name, text] : file.attributes) {
    description.facts["attributes"][name] = text;
    const bool several_lines = text.find('\n') != std::string::npos;
    description.text += several_lines
                            ? fmt::format("  {}:\n{}\n", name, text)
                            : description_line("attribute", fmt::format("{}: {}", name, text));
  }
  return description;
}

}  // namespace hiac::tools
