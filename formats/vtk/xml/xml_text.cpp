#include "formats/vtk/xml/xml_text.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "formats/common/io/printable.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

constexpr std::string_view kAppended = "<AppendedData";
constexpr std::string_view kAppendedEnd = "</AppendedData>";
constexpr std::string_view kFileEnd = "</VTKFile>";
constexpr std::string_view kXmlBlanks = " \t\r\n";
/// Names may contain "&amp;".
constexpr unsigned kParsed = pugi::parse_minimal | pugi::parse_escapes;

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kXmlBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kXmlBlanks) - begin + 1);
}

/// VTK's reader and ours follow nested elements by recursion.
constexpr int kMostDepth = 100;

/// The depth to which elements are nested.
int depth_of(pugi::xml_document& document) {
  struct : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node&) override {
      deepest = std::max(deepest, depth());
      return true;
    }
    int deepest = 0;
  } walker;
  document.traverse(walker);
  return walker.deepest;
}

}  // namespace

XmlText::XmlText(std::string_view text, const std::string& type, std::string subject)
    : text_(text), subject_(std::move(subject)) {
  // entities could multiply the text without bound; VTK's files contain none
  const std::size_t appended_at = text.find(kAppended);
  const std::string_view elements = text.substr(0, appended_at);
  if (elements.find("<!DOCTYPE") != std::string_view::npos) fail("has a document type definition");
  pugi::xml_parse_result parsed;
  if (appended_at == std::string_view::npos) {
    parsed = document_.load_buffer(text.data(), text.size(), kParsed, pugi::encoding_utf8);
  } else {
    // appended data need not be XML: the elements are closed as if they were not there
    const std::size_t tag_end = text.find('>', appended_at);
    if (tag_end == std::string_view::npos) fail("ends too soon (appended data expected)");
    std::string closed(text.substr(0, tag_end + 1));
    closed += closed[tag_end - 1] == '/' ? "" : kAppendedEnd;
    closed += kFileEnd;
    appended_ = text.substr(tag_end + 1);
    parsed = document_.load_buffer(closed.data(), closed.size(), kParsed, pugi::encoding_utf8);
  }
  if (!parsed)
    fail(fmt::format("is not well-formed: {} at byte {} of {}", parsed.description(), parsed.offset,
                     text.size()));
  if (depth_of(document_) > kMostDepth)
    fail(fmt::format("has elements that are nested too deeply (at most {} expected)", kMostDepth));
  const pugi::xml_node root = document_.document_element();
  if (std::string_view(root.name()) != "VTKFile") fail("has no VTKFile element");
  if (root.attribute("type").value() != type)
    fail(fmt::format("holds another kind of dataset ({} expected, '{}' found)", type,
                     root.attribute("type").value()));
  read_storage(root);
  find_appended_data(root);
  primary_ = root.child(type.c_str());
  if (!primary_) fail(fmt::format("has no {} element", type));
}

void XmlText::read_storage(pugi::xml_node root) {
  const std::string_view order = root.attribute("byte_order").as_string("LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian")
    fail(fmt::format("unknown byte_order '{}'", order));
  storage_.big_endian = order == "BigEndian";
  const std::string_view header = root.attribute("header_type").as_string("UInt32");
  if (header != "UInt32" && header != "UInt64")
    fail(fmt::format("unknown header_type '{}'", header));
  storage_.header_bytes = header == "UInt64" ? 8 : 4;
  const std::string_view compressor = root.attribute("compressor").as_string();
  using Compressor = XmlStorage::Compressor;
  if (compressor == "vtkZLibDataCompressor")
    storage_.compressor = Compressor::zlib;
  else if (compressor == "vtkLZ4DataCompressor")
    storage_.compressor = Compressor::lz4;
  else if (compressor == "vtkLZMADataCompressor")
    storage_.compressor = Compressor::lzma;
  else if (!compressor.empty())
    fail(fmt::format("unknown compressor '{}'", compressor));
}

void XmlText::find_appended_data(pugi::xml_node root) {
  const pugi::xml_node element = root.child("AppendedData");
  if (!element) return;
  const std::string_view encoding = element.attribute("encoding").as_string("base64");
  if (encoding != "raw" && encoding != "base64")
    fail(fmt::format("unknown encoding '{}' of appended data", encoding));
  appended_raw_ = encoding == "raw";
  // the closing tags prove that the file is complete
  const std::size_t end = appended_.rfind(kAppendedEnd);
  if (end == std::string_view::npos ||
      appended_.substr(end).find(kFileEnd) == std::string_view::npos)
    fail(fmt::format("ends too soon ({} and {} expected)", kAppendedEnd, kFileEnd));
  appended_ = appended_.substr(0, end);
  const std::size_t mark = appended_.find_first_not_of(kXmlBlanks);
  if (mark == std::string_view::npos || appended_[mark] != '_')
    fail("has no '_' before its appended data");
  appended_ = appended_.substr(mark + 1);
}

XmlArray XmlText::array(pugi::xml_node element) const {
  XmlArray array;
  array.name = element.attribute("Name").as_string();
  const char* type_name = element.attribute("type").as_string();
  const auto type = xml_number_type(type_name);
  if (!type) fail(fmt::format("array '{}': unknown type '{}'", array.name, type_name));
  array.type = *type;
  if (element.attribute("NumberOfComponents"))
    array.components = count_attribute(*this, element, "NumberOfComponents");
  if (array.components == 0 || array.components > 1'000'000)
    fail(fmt::format("array '{}': wrong number of components ({})", array.name, array.components));
  if (element.attribute("TimeStep"))
    fail(
        fmt::format("array '{}' belongs to a time step, of which the file tells none (TimeValues "
                    "expected)",
                    array.name));
  const std::string_view format = element.attribute("format").as_string();
  if (format == "appended") {
    const std::size_t offset = count_attribute(*this, element, "offset");
    if (offset > appended_.size())
      fail(
          fmt::format("array '{}': its data begin beyond the appended data (at most {} expected, "
                      "{} found)",
                      array.name, appended_.size(), offset));
    array.encoding = appended_raw_ ? XmlArray::Encoding::raw : XmlArray::Encoding::base64;
    array.data = appended_.substr(offset);
    return array;
  }
  if (format != "ascii" && format != "binary")
    fail(fmt::format("array '{}': unknown format '{}'", array.name, format));
  array.encoding = format == "ascii" ? XmlArray::Encoding::ascii : XmlArray::Encoding::base64;
  for (const pugi::xml_node child : element.children()) {
    if (child.type() != pugi::node_pcdata) continue;
    const auto at = static_cast<std::size_t>(child.offset_debug());
    const std::size_t end = std::min(text_.find('<', at), text_.size());
    array.data = trimmed(text_.substr(at, end - at));
    break;
  }
  return array;
}

std::string_view XmlText::up_to_next(pugi::xml_node element) const {
  pugi::xml_node next = element.next_sibling();
  while (next.type() != pugi::node_element) next = next.next_sibling();
  // elements begin with a '<' before their names
  const auto begin = static_cast<std::size_t>(element.offset_debug()) - 1;
  return text_.substr(begin, static_cast<std::size_t>(next.offset_debug()) - 1 - begin);
}

void XmlText::fail(const std::string& what) const { throw InputError(subject_, printable(what)); }

std::size_t count_attribute(const XmlText& text, pugi::xml_node element, const char* name) {
  const std::string_view value = trimmed(element.attribute(name).as_string());
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), count);
  // the bound keeps products of counts and sizes from overflowing
  if (value.empty() || error != std::errc() || end != value.data() + value.size() ||
      count >> 40 != 0)
    text.fail(fmt::format("{}: wrong {} (a count expected, '{}' found)", element.name(), name,
                          value.substr(0, 40)));
  return count;
}

}  // namespace hiac::formats::vtk
