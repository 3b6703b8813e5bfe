#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hiac/scene/paraview/state_document.hpp"

namespace hiac::paraview {

/// What one render view shows, by what hiac has for it.
struct ShownData {
  std::optional<Proxy> volume;  ///< a representation as volume
  std::optional<Proxy> skin;    ///< the data's surface
  std::vector<Proxy> contours;  ///< representations of Contour filters
  std::optional<Proxy> source;  ///< where the data come from
  std::vector<std::string> omitted;
};

/// Sorts the visible representations of a view. Throws InputError for two volumes, and for a volume
/// of what is no source.
ShownData shown_data(const StateDocument& state, const Proxy& view);

/// Throws InputError if a representation is moved, turned, scaled, or shows a part of its data.
void require_in_place(const Proxy& representation);

}  // namespace hiac::paraview
