#pragma once

#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace hiac::test {

/// The least state of ParaView that shows a volume, whose properties tests change.
class SmallState {
 public:
  /// Identifiers of its proxies.
  enum Id { source = 1, view = 2, shown = 3, colors = 4, opacities = 5 };

  using Values = std::vector<std::string>;

  SmallState() {
    add(source, "sources", "XMLUnstructuredGridReader", {{"FileName", {"none.vtu"}}});
    add(view, "views", "RenderView",
        {{"CameraPosition", {"0", "0", "9"}},
         {"CameraFocalPoint", {"0", "0", "0"}},
         {"CameraViewUp", {"0", "1", "0"}},
         {"ViewSize", {"40", "30"}},
         {"Background", {"0", "0", "0"}},
         {"Representations", {"@3"}}});
    add(shown, "representations", "UnstructuredGridRepresentation",
        {{"Input", {"@1"}},
         {"Representation", {"Volume"}},
         {"ColorArrayName", {"", "", "", "0", "t"}},
         {"LookupTable", {"@4"}},
         {"ScalarOpacityFunction", {"@5"}},
         {"SelectMapper", {"Projected tetra"}}});
    add(colors, "lookup_tables", "PVLookupTable",
        {{"RGBPoints", {"0", "0", "0", "0", "2", "1", "1", "1"}}});
    add(opacities, "piecewise_functions", "PiecewiseFunction",
        {{"Points", {"0", "0", "0.5", "0", "2", "1", "0.5", "0"}}});
  }

  SmallState& add(int id, const std::string& group, const std::string& type,
                  const std::map<std::string, Values>& properties) {
    proxies_[id] = {group, type, properties};
    return *this;
  }
  /// A value that begins with @ refers to a proxy.
  SmallState& set(int id, const std::string& property, const Values& values) {
    proxies_.at(id).properties[property] = values;
    return *this;
  }
  SmallState& without(int id, const std::string& property) {
    proxies_.at(id).properties.erase(property);
    return *this;
  }

  [[nodiscard]] std::string text() const {
    std::string text = "<ParaView>\n<ServerManagerState version=\"5.11.0\">\n";
    for (const auto& [id, proxy] : proxies_) {
      text +=
          fmt::format("<Proxy group=\"{}\" type=\"{}\" id=\"{}\">\n", proxy.group, proxy.type, id);
      for (const auto& [name, values] : proxy.properties) {
        text += fmt::format("<Property name=\"{}\">", name);
        for (const std::string& value : values)
          text += value.starts_with('@') ? fmt::format("<Proxy value=\"{}\"/>", value.substr(1))
                                         : fmt::format("<Element value=\"{}\"/>", value);
        text += "</Property>\n";
      }
      text += "</Proxy>\n";
    }
    return text + "</ServerManagerState>\n</ParaView>\n";
  }

 private:
  struct Entry {
    std::string group, type;
    std::map<std::string, Values> properties;
  };
  std::map<int, Entry> proxies_;
};

}  // namespace hiac::test
