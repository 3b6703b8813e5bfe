#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "formats/hdf5/hdf5_file.hpp"

namespace hiac::formats::xdmf {

/// An XDMF document and the numbers that its DataItems name: in the text itself, in HDF5 files and
/// in raw binary files beside it. Throws InputError naming the file and the element.
class DataItems {
 public:
  DataItems(const pugi::xml_document& document, std::string path);

  /// The DataItem below `parent`, or the one that it refers to.
  [[nodiscard]] pugi::xml_node item_in(const pugi::xml_node& parent, std::size_t number = 0) const;
  /// The node itself, or the node that its Reference attribute names by an XPath.
  [[nodiscard]] pugi::xml_node resolved(const pugi::xml_node& node) const;

  /// The item's declared extents.
  [[nodiscard]] std::vector<std::uint64_t> shape(const pugi::xml_node& item) const;
  /// "double", "float", "int32", ... as declared.
  [[nodiscard]] std::string type(const pugi::xml_node& item) const;
  [[nodiscard]] std::vector<double> reals(const pugi::xml_node& item);
  [[nodiscard]] std::vector<std::int64_t> integers(const pugi::xml_node& item);

  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& problem) const;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  template <typename T>
  std::vector<T> numbers(const pugi::xml_node& item);
  template <typename T>
  std::vector<T> selected(const pugi::xml_node& item);
  template <typename T>
  std::vector<T> joined(const pugi::xml_node& item);
  template <typename T>
  std::vector<T> from_text(const pugi::xml_node& item) const;
  template <typename T>
  std::vector<T> from_hdf5(const pugi::xml_node& item);
  template <typename T>
  std::vector<T> from_binary(const pugi::xml_node& item) const;
  [[nodiscard]] std::string beside(const std::string& name) const;

  const pugi::xml_document& document_;
  std::string path_;
  std::map<std::string, std::shared_ptr<hdf5::File>> files_;
  int depth_ = 0;
};

/// The text without blanks at either end.
std::string stripped(const char* text);

/// Whether two words are equal apart from case, which XDMF 3 ignores.
bool same_word(std::string_view a, std::string_view b);

/// The document with references to the entities that it declares itself (<!ENTITY HeavyData
/// "mesh.h5">, &HeavyData;) replaced. Throws InputError(subject, ...) when that makes it larger
/// than ten times its size.
std::string with_entities(std::string_view document, const std::string& subject);

}  // namespace hiac::formats::xdmf
