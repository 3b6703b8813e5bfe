#pragma once

#include <string>

#include <fmt/format.h>

#include "tests/formats/files.hpp"

namespace hiac::formats {

// XDMF documents of one tetrahedron whose parts can be exchanged.

inline std::string xdmf_item(const std::string& dimensions, const std::string& text,
                             const std::string& more = "") {
  return fmt::format("<DataItem Dimensions=\"{}\"{}>{}</DataItem>", dimensions, more, text);
}

struct XdmfGrid {
  std::string topology =
      "<Topology TopologyType=\"Tetrahedron\">" + xdmf_item("1 4", "0 1 2 3") + "</Topology>";
  std::string geometry = "<Geometry>" + xdmf_item("4 3", "0 0 0 1 0 0 0 1 0 0 0 1") + "</Geometry>";
  std::string attribute = "";
  std::string before = "";  ///< the grid, in the domain
  std::string grid_attributes = "";

  [[nodiscard]] std::string grid() const {
    return "<Grid Name=\"g\"" + grid_attributes + ">" + topology + geometry + attribute + "</Grid>";
  }
  [[nodiscard]] std::string text() const {
    return "<Xdmf xmlns:xi=\"x\"><Domain>" + before + grid() + "</Domain></Xdmf>";
  }
};

/// That the document is refused for its first element that begins with `tag`, with that message
/// behind the element's place and name; an empty message: that it is read.
inline void expect_xdmf(const std::string& text, const std::string& tag,
                        const std::string& message) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.xmf", text);
  EXPECT_EQ(refusal(path), message.empty() ? ""
                                           : fmt::format("{}: byte {}: {}", path,
                                                         text.find("<" + tag) + 1, message))
      << text;
}

/// The same where the message names no element.
inline void expect_xdmf_file(const std::string& text, const std::string& message) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.xmf", text);
  EXPECT_EQ(refusal(path), message.empty() ? "" : path + ": " + message) << text;
}

}  // namespace hiac::formats
