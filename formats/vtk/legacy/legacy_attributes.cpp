// Based on: as legacy_layout.cpp.
#include "formats/vtk/legacy/legacy_attributes.hpp"

#include <charconv>

#include <fmt/format.h>

namespace hiac::formats::vtk {
namespace {

using Family = NumberType::Family;

/// The number of components of an attribute for which it is fixed; 0 for other words.
std::size_t fixed_components(const std::string& keyword, bool on_points) {
  if (keyword == "vectors" || keyword == "normals") return 3;
  if (keyword == "tensors6") return 6;
  if (keyword == "tensors") return 9;
  if (keyword == "global_ids" || keyword == "pedigree_ids") return 1;
  return keyword == "edge_flags" && on_points ? 1 : 0;
}

}  // namespace

void LegacyAttributes::read(const std::string& keyword, bool on_points) {
  if (keyword == "field") return read_field(on_points);
  if (keyword == "lookup_table") return read_lookup_table();
  const bool scalars =
      keyword == "scalars" || keyword == "color_scalars" || keyword == "texture_coordinates";
  const std::size_t fixed = fixed_components(keyword, on_points);
  if (!scalars && fixed == 0)
    words_.fail(fmt::format("unexpected '{}' (SCALARS, VECTORS, FIELD, ... expected)",
                            keyword.substr(0, 40)));
  const std::size_t count = on_points ? layout_.points : layout_.cells;
  const std::string name(words_.name());
  if (keyword == "color_scalars") {
    const std::size_t components = words_.count("the number of components");
    // the reader converts them to bytes, which cannot hold values that are not finite
    if (!layout_.binary) {
      walk_legacy_array(words_, {Family::real, 4}, count, components, false);
      return;
    }
    return keep(name, {Family::unsigned_integer, 1}, count, components, on_points);
  }
  if (keyword == "scalars") {
    const NumberType type = read_legacy_type(words_, true);
    return keep(name, type, count, scalar_components(), on_points);
  }
  if (keyword == "texture_coordinates") {
    const std::size_t components = words_.count("the number of components");
    if (components < 1 || components > 3) words_.fail("wrong dimension (1 to 3 expected)");
    return keep(name, read_legacy_type(words_, true), count, components, on_points);
  }
  const bool may_be_text = keyword == "pedigree_ids" || keyword == "edge_flags";
  keep(name, read_legacy_type(words_, !may_be_text), count, fixed, on_points);
}

std::size_t LegacyAttributes::scalar_components() {
  std::size_t components = 1;
  std::string keyword = words_.keyword("LOOKUP_TABLE");
  if (keyword != "lookup_table") {
    const auto [end, error] =
        std::from_chars(keyword.data(), keyword.data() + keyword.size(), components);
    if (error != std::errc() || end != keyword.data() + keyword.size() || components < 1 ||
        components > 1'000'000)
      words_.fail("LOOKUP_TABLE or a number of components expected");
    keyword = words_.keyword("LOOKUP_TABLE");
  }
  if (keyword != "lookup_table") words_.fail("LOOKUP_TABLE expected");
  words_.keyword("the name of a lookup table");
  return components;
}

void LegacyAttributes::read_lookup_table() {
  words_.keyword("the name of a lookup table");
  const std::size_t size = words_.count("the size of a lookup table");
  const NumberType type =
      layout_.binary ? NumberType{Family::unsigned_integer, 1} : NumberType{Family::real, 4};
  walk_legacy_values(words_, type, 4 * size, false);
}

void LegacyAttributes::read_field(std::optional<bool> on_points) {
  words_.name();
  const std::size_t arrays = words_.count("the number of arrays");
  if (arrays > words_.left())
    words_.fail(fmt::format("too many arrays ({} declared, {} bytes left)", arrays, words_.left()));
  for (std::size_t i = 0; i < arrays; ++i) {
    const std::string name(words_.name());
    if (name == "NULL_ARRAY") continue;
    const std::size_t components = words_.count("the number of components");
    const std::size_t tuples = words_.count("the number of tuples");
    const NumberType type = read_legacy_type(words_, false);
    if (!on_points) {
      walk_legacy_array(words_, type, tuples, components, false);
      continue;
    }
    const std::size_t expected = *on_points ? layout_.points : layout_.cells;
    if (tuples != expected)
      words_.fail(fmt::format("array '{}' does not fit the {} ({} tuples expected, {} found)",
                              name.substr(0, 60), *on_points ? "points" : "cells", expected,
                              tuples));
    keep(name, type, tuples, components, *on_points);
  }
}

void LegacyAttributes::keep(const std::string& name, const NumberType& type, std::size_t tuples,
                            std::size_t components, bool on_points) {
  const LegacyValues values = walk_legacy_array(words_, type, tuples, components, true);
  layout_.attributes.push_back(
      {name, type, tuples, components, values.begin, values.end, on_points, values.has_not_finite});
}

}  // namespace hiac::formats::vtk
