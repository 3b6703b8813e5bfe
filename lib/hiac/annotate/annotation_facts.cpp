#include "hiac/annotate/annotation_facts.hpp"

#include <charconv>

#include <fmt/format.h>

namespace hiac {
namespace {

/// 0.30000000000000004 becomes 0.3; what is no number stays.
std::string short_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return text;
  return fmt::format("{:.6g}", value);
}

}  // namespace

std::string field_label(const ZooMesh& mesh, const std::string& field) {
  const std::string unit = scalar_field(mesh, field).unit;
  return unit.empty() ? field : fmt::format("{} ({})", field, unit);
}

AnnotationFacts annotation_facts(const ZooMesh& mesh, const Volume& volume) {
  AnnotationFacts facts;
  if (volume.color) facts.color_label = field_label(mesh, volume.color->field);
  for (const auto& [key, text] : mesh.metadata)
    if (key == "time") facts.time = short_number(text);
  return facts;
}

}  // namespace hiac
