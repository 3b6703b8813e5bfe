#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hiac::formats::cgns {

/// A node of a CGNS file's tree.
struct Node {
  double id = 0;
  std::string name;
  std::string label;               ///< "Zone_t"
  std::string type;                ///< "I4", "R8", "C1", "MT" ...
  std::vector<std::size_t> shape;  ///< the first dimension fastest
};

/// A CGNS file for reading. For use in a process that may crash (read_isolated). Throws InputError
/// naming the file and the node; memory is allocated only when the file is large enough for the
/// data.
class CgnsFile {
 public:
  explicit CgnsFile(const std::string& path);
  ~CgnsFile();
  CgnsFile(const CgnsFile&) = delete;
  CgnsFile& operator=(const CgnsFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::size_t size() const { return file_size_; }
  [[nodiscard]] Node root() const;
  /// The children with that label; all children when it is empty.
  [[nodiscard]] std::vector<Node> children(const Node& node, std::string_view label = {}) const;
  [[nodiscard]] std::optional<Node> child(const Node& node, std::string_view name) const;
  /// The first child with that label.
  [[nodiscard]] std::optional<Node> labelled(const Node& node, std::string_view label) const;

  [[nodiscard]] std::vector<double> reals(const Node& node) const;
  [[nodiscard]] std::vector<std::int64_t> integers(const Node& node) const;
  /// The characters of a node as one text; rows of characters are joined.
  [[nodiscard]] std::string text(const Node& node) const;

  [[noreturn]] void fail(const Node& node, const std::string& problem) const;

 private:
  [[nodiscard]] std::vector<char> bytes(const Node& node) const;
  [[nodiscard]] Node node_at(double id) const;
  /// Throws InputError for a link to a file outside the input's folder.
  void require_local_link(double id) const;

  std::string path_;
  std::size_t file_size_ = 0;
  bool packed_ = false;  ///< HDF5, which may be compressed
  int file_ = 0;
};

}  // namespace hiac::formats::cgns
