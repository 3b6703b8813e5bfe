#include "hiac/scene/paraview/paraview_view.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/paraview/light_kit.hpp"
#include "hiac/scene/paraview/shown_data.hpp"
#include "hiac/scene/paraview/state_document.hpp"
#include "hiac/scene/paraview/surface_text.hpp"
#include "hiac/scene/paraview/view_text.hpp"
#include "hiac/scene/paraview/volume_text.hpp"
#include "hiac/scene/toml/spec_text.hpp"

namespace hiac {
namespace {

using namespace paraview;
namespace fs = std::filesystem;

/// The size of a picture whose camera comes without one: that of starter views.
constexpr const char* kCameraFileSize = "[image]\nwidth = 1024\nheight = 768\n";

/// PATH and VIEW of `PATH#VIEW`; a file of the whole name goes first.
struct StateName {
  std::string path, view;
};

StateName split(const std::string& name) {
  std::error_code error;
  const std::size_t hash = name.rfind('#');
  if (hash == std::string::npos || fs::exists(name, error)) return {name, ""};
  return {name.substr(0, hash), name.substr(hash + 1)};
}

/// The view that is asked for, or the first one.
Proxy chosen_view(const StateDocument& state, const StateName& name,
                  std::vector<std::string>& notes) {
  const std::vector<Proxy> views = state.all("views", "RenderView");
  if (views.empty()) throw InputError(state.subject(), "holds no render view");
  std::vector<std::string> names;
  for (const Proxy& view : views) names.push_back(state.name(view));
  const auto found = name.view.empty() ? names.begin() : std::ranges::find(names, name.view);
  if (found == names.end())
    throw UsageError(fmt::format("{}: no render view of the name {} (expected one of {})",
                                 state.subject(), in_one_line(name.view), fmt::join(names, ", ")));
  if (name.view.empty() && names.size() > 1)
    notes.push_back(fmt::format("view: {}, the first of {} ({}#NAME takes another)", *found,
                                fmt::join(names, ", "), state.subject()));
  else
    notes.push_back(fmt::format("view: {}", *found));
  return views[static_cast<std::size_t>(found - names.begin())];
}

/// The file that a source reads: as the state names it, else beside the state; "" for none.
std::string data_file_of(const StateDocument& state, const Proxy& source) {
  for (const char* property : {"FileName", "FileNames"}) {
    const std::string named = source.text(property);
    if (named.empty()) continue;
    std::error_code error;
    if (fs::exists(named, error)) return named;
    const fs::path path(named.substr(named.find_last_of("/\\") + 1));
    const fs::path beside = fs::path(state.subject()).parent_path() / path;
    return fs::exists(beside, error) ? beside.string() : named;
  }
  return "";
}

/// The lights of a view that shows surfaces: the light kit's, or none.
std::string lights_text(const Proxy& view, ParaviewView& into) {
  if (view.flag("StereoRender")) into.omitted.emplace_back("stereo: one picture is drawn");
  if (!view.references("AdditionalLights").empty())
    into.omitted.emplace_back("additional lights: have no equal here, and do not shine");
  into.omitted.emplace_back(
      "the shading of surfaces: is added up as display values in ParaView, as light here");
  const std::string kit = light_kit_text(view);
  into.notes.emplace_back(kit.empty()
                              ? "lights: none, as the view has its light kit switched off"
                              : "lights: the five of the light kit, as this camera has them");
  return kit.empty() ? "[[light]]\ncolor = [0, 0, 0]\n" : kit;
}

std::string scene_text(const StateDocument& state, const Proxy& view, ParaviewView& into) {
  const ShownData shown = shown_data(state, view);
  into.omitted = shown.omitted;
  std::string text = image_text(view) + "\n" + camera_text(view) + "\n" +
                     background_text(state, view, into.omitted) + "\n";
  if (shown.volume) {
    require_in_place(*shown.volume);
    text += volume_text(state, *shown.volume, into.notes) + "\n";
  }
  for (const Proxy& contour : shown.contours) {
    require_in_place(contour);
    text += isosurface_text(state, contour, into.omitted) + "\n";
  }
  if (shown.skin) {
    require_in_place(*shown.skin);
    text += skin_text(state, *shown.skin, into.notes, into.omitted) + "\n";
  }
  if (!shown.contours.empty() || shown.skin) text += lights_text(view, into);
  if (!shown.source)
    throw InputError(state.subject(),
                     fmt::format("nothing that the view {} shows can be drawn (a volume, a "
                                 "surface or contours of a file expected)",
                                 state.name(view)));
  into.data_file = data_file_of(state, *shown.source);
  return text;
}

/// What a specification says of its origin.
std::string heading(const StateDocument& state, const ParaviewView& view) {
  const auto comment = [](const std::string& line) { return "# " + in_one_line(line) + "\n"; };
  std::string text =
      comment(fmt::format("A view of ParaView {}: {}", state.version(), state.subject()));
  for (const std::string& line : view.notes) text += comment(line);
  for (const std::string& line : view.omitted) text += comment("not as in ParaView: " + line);
  return text + "\n";
}

}  // namespace

bool is_paraview_file(const std::string& name) {
  const std::string path = name.substr(0, name.rfind('#'));
  return std::ranges::any_of(std::array{".pvsm", ".pvcc"}, [&](const char* extension) {
    return name.ends_with(extension) || path.ends_with(extension);
  });
}

std::string paraview_file_of(const std::string& name) { return split(name).path; }

ParaviewView view_from_state(const std::string& name) {
  const StateName parts = split(name);
  const StateDocument state(parts.path);
  ParaviewView view;
  if (const std::optional<Proxy> camera = state.camera()) {
    view.is_camera_file = true;
    view.text = kCameraFileSize + std::string("\n") + camera_text(*camera);
    return view;
  }
  const Proxy chosen = chosen_view(state, parts, view.notes);
  const std::string text = scene_text(state, chosen, view);
  view.text = heading(state, view) + text;
  return view;
}

}  // namespace hiac
