#include "hiac/scene/paraview/shown_data.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::paraview {
namespace {

bool is_source(const Proxy& proxy) { return proxy.group() == "sources"; }

/// What messages call a representation: what it shows, and how.
std::string described(const StateDocument& state, const Proxy& shown, const Proxy& input) {
  return fmt::format(
      "{} ({}) as {}", state.name(input), input.type(),
      shown.text("Representation").empty() ? shown.type() : shown.text("Representation"));
}

/// Where a contour's values come from: the source that it is a filter of, if it is the first one.
std::optional<Proxy> contoured_source(const StateDocument& state, const Proxy& input) {
  if (input.type() != "Contour" || input.group() != "filters") return std::nullopt;
  const std::optional<Proxy> source = state.referred(input, "Input");
  if (!source || !is_source(*source)) return std::nullopt;
  return source;
}

bool is_surface(const Proxy& shown) { return shown.text("Representation").starts_with("Surface"); }

class Sorter {
 public:
  explicit Sorter(const StateDocument& state) : state_(state) {}

  void take(const Proxy& shown) {
    const std::optional<Proxy> input = state_.referred(shown, "Input");
    if (!input) {
      data_.omitted.push_back(fmt::format("{}: shows no data of the pipeline", shown.type()));
      return;
    }
    if (shown.text("Representation") == "Volume") return take_volume(shown, *input);
    if (const std::optional<Proxy> source = contoured_source(state_, *input);
        source && is_surface(shown) && is_of(*source)) {
      data_.contours.push_back(shown);
      return;
    }
    if (is_source(*input) && is_surface(shown) && !data_.skin && is_of(*input)) {
      data_.skin = shown;
      return;
    }
    data_.omitted.push_back(
        fmt::format("{}: has no equal here and is not drawn", described(state_, shown, *input)));
  }

  ShownData result() { return std::move(data_); }

 private:
  void take_volume(const Proxy& shown, const Proxy& input) {
    if (data_.volume)
      throw InputError(state_.subject(),
                       fmt::format("the view shows two volumes, of {} and of {} (one is expected: "
                                   "hide the other and save the state again)",
                                   state_.name(*data_.source), state_.name(input)));
    if (!is_source(input))
      throw InputError(
          state_.subject(),
          fmt::format("the volume shows the output of the filter {} ({}), which only ParaView can "
                      "compute (expected a volume of a file: save the filter's data and open them "
                      "in ParaView, or use the macro)",
                      state_.name(input), input.type()));
    data_.volume = shown;
    data_.source = input;
  }

  /// Whether a source is that of all that is drawn; the first one is.
  bool is_of(const Proxy& source) {
    if (!data_.source) data_.source = source;
    return data_.source->id() == source.id();
  }

  const StateDocument& state_;
  ShownData data_;
};

void require_numbers(const Proxy& shown, const char* property,
                     const std::vector<double>& identity) {
  if (shown.has(property) && !shown.numbers(property).empty() &&
      shown.numbers(property) != identity)
    shown.fail(property, "data that are moved, turned or scaled have no equal here");
}

}  // namespace

ShownData shown_data(const StateDocument& state, const Proxy& view) {
  std::vector<Proxy> visible;
  for (const std::string& id : view.references("Representations")) {
    const std::optional<Proxy> shown = state.find(id);
    if (shown && shown->number("Visibility", 1) != 0) visible.push_back(*shown);
  }
  // the volume says which data all else has to be of
  std::ranges::stable_partition(
      visible, [](const Proxy& shown) { return shown.text("Representation") == "Volume"; });
  Sorter sorter(state);
  for (const Proxy& shown : visible) sorter.take(shown);
  return sorter.result();
}

void require_in_place(const Proxy& representation) {
  for (const char* property : {"Position", "Orientation"})
    require_numbers(representation, property, {0, 0, 0});
  require_numbers(representation, "Scale", {1, 1, 1});
  std::vector<double> identity(16, 0.0);
  for (std::size_t i = 0; i < 4; ++i) identity[5 * i] = 1;
  require_numbers(representation, "UserTransform", identity);
  const std::vector<std::string> blocks = representation.texts("BlockSelectors");
  if (std::ranges::any_of(blocks, [](const std::string& b) { return b != "/" && b != "/Root"; }))
    representation.fail("BlockSelectors", "some blocks alone have no equal here (all expected)");
}

}  // namespace hiac::paraview
