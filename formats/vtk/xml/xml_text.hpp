#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <pugixml.hpp>

#include "formats/vtk/xml/xml_array.hpp"

namespace hiac::formats::vtk {

/// The elements of a VTK XML file, and the position of its appended data.
class XmlText {
 public:
  /// Throws InputError(subject, ...) when the text is not well-formed to its end, or when its root
  /// is not a VTKFile of that type with attributes that the reader knows.
  XmlText(std::string_view text, const std::string& type, std::string subject);

  /// The element with the type's name.
  [[nodiscard]] pugi::xml_node primary() const { return primary_; }
  [[nodiscard]] const XmlStorage& storage() const { return storage_; }
  [[nodiscard]] const std::string& subject() const { return subject_; }

  /// The array that a DataArray (or Array) element describes; its data are not yet checked.
  [[nodiscard]] XmlArray array(pugi::xml_node element) const;

  /// An element in the file's text, with what stands between it and the next one beside it, which
  /// must exist.
  [[nodiscard]] std::string_view up_to_next(pugi::xml_node element) const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  void find_appended_data(pugi::xml_node root);
  void read_storage(pugi::xml_node root);

  std::string_view text_;
  std::string subject_;
  pugi::xml_document document_;
  pugi::xml_node primary_;
  XmlStorage storage_;
  std::string_view appended_;
  bool appended_raw_ = false;
};

/// The non-negative integer in an attribute. Throws through `text` when it is not one.
std::size_t count_attribute(const XmlText& text, pugi::xml_node element, const char* name);

}  // namespace hiac::formats::vtk
