#include "formats/xdmf/grids.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "formats/common/mesh/steps.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::xdmf {
namespace {

constexpr int kMostDepth = 32;

bool is_temporal(const pugi::xml_node& grid) {
  return same_word(grid.attribute("GridType").as_string(), "Collection") &&
         same_word(grid.attribute("CollectionType").as_string(), "Temporal");
}
bool is_group(const pugi::xml_node& grid) {
  const std::string_view type = grid.attribute("GridType").as_string("Uniform");
  return same_word(type, "Collection") || same_word(type, "Tree");
}

class GridTree {
 public:
  GridTree(const pugi::xml_document& document, DataItems& items)
      : document_(document), items_(items) {}

  Grids read(const ReadOptions& options) {
    const pugi::xml_node domain = document_.child("Xdmf").child("Domain");
    if (!domain) throw InputError(items_.path(), "has no Domain below Xdmf");
    find_times(domain, 0);
    std::sort(grids_.times.begin(), grids_.times.end());
    grids_.times.erase(std::unique(grids_.times.begin(), grids_.times.end()), grids_.times.end());
    if (const auto step = requested_step(options, grids_.times, items_.path()))
      grids_.step = *step;
    else if (!grids_.times.empty())
      grids_.step = grids_.times.size() - 1;
    for (const pugi::xml_node grid : domain.children("Grid")) collect(grid, 0);
    for (const pugi::xml_node grid : domain.children("Grid"))
      find_field_steps(grid, std::nullopt, 0);
    return std::move(grids_);
  }

 private:
  /// The times of a temporal collection's grids.
  std::vector<double> times_of(const pugi::xml_node& collection) {
    std::vector<double> times;
    std::vector<double> listed;
    const pugi::xml_node time = collection.child("Time");
    const std::string_view sort = time.attribute("TimeType").as_string();
    if (time && time.child("DataItem")) {
      listed = items_.reals(items_.item_in(time));
      if (same_word(sort, "HyperSlab") && listed.size() == 3) {
        const auto [start, stride, count] = std::tuple(listed[0], listed[1], listed[2]);
        listed.clear();
        for (double i = 0; i < std::min(count, 1e6); ++i) listed.push_back(start + i * stride);
      }
    }
    std::size_t number = 0;
    for (const pugi::xml_node grid : collection.children("Grid")) {
      const pugi::xml_attribute value = grid.child("Time").attribute("Value");
      if (value)
        times.push_back(value.as_double());
      else
        times.push_back(number < listed.size() ? listed[number] : static_cast<double>(number));
      ++number;
    }
    return times;
  }

  void find_times(const pugi::xml_node& parent, int depth) {
    if (depth > kMostDepth) throw InputError(items_.path(), "its grids are nested too deeply");
    for (const pugi::xml_node grid : parent.children("Grid")) {
      if (is_temporal(grid)) {
        const std::vector<double> times = times_of(grid);
        grids_.times.insert(grids_.times.end(), times.begin(), times.end());
      } else if (is_group(grid)) {
        find_times(grid, depth + 1);
      }
    }
  }

  /// Records the names of the attributes of every step; `step`: that of the grid.
  void find_field_steps(const pugi::xml_node& grid, std::optional<std::size_t> step, int depth) {
    if (depth > kMostDepth) return;
    if (is_temporal(grid)) {
      const std::vector<double> times = times_of(grid);
      std::size_t number = 0;
      for (const pugi::xml_node child : grid.children("Grid")) {
        const auto found =
            std::lower_bound(grids_.times.begin(), grids_.times.end(), times[number++]);
        find_field_steps(child, static_cast<std::size_t>(found - grids_.times.begin()), depth + 1);
      }
      return;
    }
    for (const pugi::xml_node child : grid.children("Grid"))
      find_field_steps(child, step, depth + 1);
    if (step)
      for (const pugi::xml_node attribute : grid.children("Attribute"))
        grids_.field_steps[attribute.attribute("Name").as_string("attribute")].insert(*step);
  }

  /// Collects the leaves of a grid at the chosen step.
  void collect(const pugi::xml_node& grid, int depth) {
    if (depth > kMostDepth) throw InputError(items_.path(), "its grids are nested too deeply");
    if (is_temporal(grid)) {
      const std::vector<double> times = times_of(grid);
      std::size_t number = 0;
      for (const pugi::xml_node child : grid.children("Grid"))
        if (times[number++] == grids_.times[grids_.step]) return collect(child, depth + 1);
      return;
    }
    if (is_group(grid)) {
      for (const pugi::xml_node child : grid.children("Grid")) collect(child, depth + 1);
      return;
    }
    const std::string_view type = grid.attribute("GridType").as_string("Uniform");
    if (!same_word(type, "Uniform"))
      items_.fail(grid,
                  fmt::format("is of the type '{}' (Uniform, Collection or Tree expected)", type));
    add_grid(grid);
  }

  /// The children of a grid, in which every XInclude is replaced by the nodes that it includes.
  std::vector<pugi::xml_node> parts_of(const pugi::xml_node& grid) {
    std::vector<pugi::xml_node> parts;
    for (const pugi::xml_node child : grid.children()) {
      if (std::string_view(child.name()) != "xi:include") {
        parts.push_back(items_.resolved(child));
        continue;
      }
      std::string path = child.attribute("xpointer").as_string();
      if (child.attribute("href")) items_.fail(child, "includes another file (one file expected)");
      if (path.starts_with("xpointer(") && path.ends_with(')'))
        path = path.substr(9, path.size() - 10);
      try {
        for (const pugi::xpath_node& found : document_.select_nodes(path.c_str()))
          parts.push_back(items_.resolved(found.node()));
      } catch (const pugi::xpath_exception&) {
        items_.fail(child, fmt::format("'{}' is no XPath that is understood", path));
      }
    }
    return parts;
  }

  void add_grid(const pugi::xml_node& grid) {
    UniformGrid leaf;
    leaf.name = grid.attribute("Name").as_string();
    for (const pugi::xml_node part : parts_of(grid)) {
      const std::string_view name = part.name();
      if (name == "Topology") leaf.topology = part;
      if (name == "Geometry") leaf.geometry = part;
      if (name == "Attribute") leaf.attributes.push_back(part);
    }
    if (!leaf.topology || !leaf.geometry) items_.fail(grid, "has no Topology or no Geometry");
    // a grid with the mesh of an earlier grid only adds attributes to it
    for (UniformGrid& other : grids_.uniform) {
      if (other.topology != leaf.topology || other.geometry != leaf.geometry) continue;
      other.attributes.insert(other.attributes.end(), leaf.attributes.begin(),
                              leaf.attributes.end());
      return;
    }
    grids_.uniform.push_back(std::move(leaf));
  }

  const pugi::xml_document& document_;
  DataItems& items_;
  Grids grids_;
};

}  // namespace

Grids grids_of(const pugi::xml_document& document, DataItems& items, const ReadOptions& options) {
  return GridTree(document, items).read(options);
}

}  // namespace hiac::formats::xdmf
