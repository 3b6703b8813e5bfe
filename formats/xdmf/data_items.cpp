#include "formats/xdmf/data_items.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>
#include <type_traits>

#include <fmt/format.h>

#include "formats/common/io/mapped_file.hpp"
#include "formats/common/io/named_file.hpp"
#include "formats/common/io/product.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::xdmf {
namespace {

constexpr int kMostNesting = 8;

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == ','; }

/// All numbers of a text; nothing when one of its words is not a number.
template <typename T>
bool parse_all(std::string_view text, std::vector<T>& values) {
  const char* at = text.data();
  const char* end = at + text.size();
  while (true) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return true;
    at = without_plus({at, end}).data();
    T value{};
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || (next != end && !is_blank(*next))) return false;
    values.push_back(value);
    at = next;
  }
}

/// An entity that a document declares: "&NAME;" and its replacement.
struct Entity {
  std::string reference;
  std::string value;
};

std::vector<Entity> entities_of(std::string_view document) {
  constexpr std::string_view kDeclaration = "<!ENTITY";
  std::vector<Entity> entities;
  for (std::size_t at = document.find(kDeclaration); at != std::string_view::npos;
       at = document.find(kDeclaration, at + 1)) {
    const std::string_view rest = document.substr(at + kDeclaration.size());
    const std::size_t open = rest.find_first_of("\"'>");
    if (open == std::string_view::npos || rest[open] == '>') continue;
    const std::size_t close = rest.find(rest[open], open + 1);
    if (close == std::string_view::npos) continue;
    const std::string name = stripped(std::string(rest.substr(0, open)).c_str());
    entities.push_back(
        {fmt::format("&{};", name), std::string(rest.substr(open + 1, close - open - 1))});
  }
  return entities;
}

/// A value that is stored in another type and byte order, as T.
template <typename Stored, typename T>
T converted(const char* at, bool swap) {
  std::array<char, sizeof(Stored)> bytes;
  std::memcpy(bytes.data(), at, bytes.size());
  if (swap) std::reverse(bytes.begin(), bytes.end());
  return static_cast<T>(std::bit_cast<Stored>(bytes));
}

template <typename T>
using Convert = T (*)(const char*, bool);

template <typename T>
Convert<T> conversion_from(const std::string& type) {
  if (type == "double") return converted<double, T>;
  if (type == "float") return converted<float, T>;
  if (type == "int8") return converted<std::int8_t, T>;
  if (type == "uint8") return converted<std::uint8_t, T>;
  if (type == "int16") return converted<std::int16_t, T>;
  if (type == "uint16") return converted<std::uint16_t, T>;
  if (type == "int32") return converted<std::int32_t, T>;
  if (type == "uint32") return converted<std::uint32_t, T>;
  if (type == "int64") return converted<std::int64_t, T>;
  if (type == "uint64") return converted<std::uint64_t, T>;
  return nullptr;
}

}  // namespace

std::string stripped(const char* text) {
  std::string_view view(text);
  while (!view.empty() && is_blank(view.front())) view.remove_prefix(1);
  while (!view.empty() && is_blank(view.back())) view.remove_suffix(1);
  return std::string(view);
}

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char c, unsigned char d) {
    return std::tolower(c) == std::tolower(d);
  });
}

std::string with_entities(std::string_view document, const std::string& subject) {
  const std::vector<Entity> entities = entities_of(document);
  std::string result;
  for (std::size_t at = 0; at < document.size();) {
    const std::string_view rest = document.substr(at);
    const auto used = std::find_if(entities.begin(), entities.end(), [&](const Entity& entity) {
      return rest.front() == '&' && rest.starts_with(entity.reference);
    });
    if (used != entities.end()) {
      result.append(used->value);
      at += used->reference.size();
    } else {
      const std::size_t next = std::min(rest.find('&', 1), rest.size());
      result.append(rest.substr(0, next));
      at += next;
    }
    if (result.size() / 10 > document.size())
      throw InputError(subject, "its entities make it more than ten times as large");
  }
  return result;
}

DataItems::DataItems(const pugi::xml_document& document, std::string path)
    : document_(document), path_(std::move(path)) {}

void DataItems::fail(const pugi::xml_node& node, const std::string& problem) const {
  const std::string name = node.attribute("Name").as_string();
  throw InputError(path_,
                   fmt::format("byte {}: {}{}{}{}: {}", node.offset_debug(), node.name(),
                               name.empty() ? "" : " '", name, name.empty() ? "" : "'", problem));
}

pugi::xml_node DataItems::resolved(const pugi::xml_node& node) const {
  std::string reference = node.attribute("Reference").as_string();
  if (reference.empty()) return node;
  if (reference == "XML") reference = stripped(node.child_value());
  try {
    const pugi::xml_node found = document_.select_node(reference.c_str()).node();
    if (found && found != node) return found;
  } catch (const pugi::xpath_exception&) {
  }
  fail(node, fmt::format("refers to '{}', which is not there", reference));
}

pugi::xml_node DataItems::item_in(const pugi::xml_node& parent, std::size_t number) const {
  for (const pugi::xml_node item : parent.children("DataItem")) {
    if (number-- > 0) continue;
    return resolved(item);
  }
  fail(parent, "has too few DataItems");
}

std::vector<std::uint64_t> DataItems::shape(const pugi::xml_node& item) const {
  std::vector<std::uint64_t> extents;
  if (!parse_all(std::string_view(item.attribute("Dimensions").as_string()), extents) ||
      extents.empty())
    fail(item, "has no Dimensions");
  return extents;
}

std::string DataItems::type(const pugi::xml_node& item) const {
  const char* name = item.attribute("NumberType").as_string();
  if (*name == '\0') name = item.attribute("DataType").as_string("Float");
  const std::string_view kind = name;
  const std::string precision = item.attribute("Precision").as_string("4");
  if (same_word(kind, "Float")) return precision == "8" ? "double" : "float";
  if (same_word(kind, "Char")) return "int8";
  if (same_word(kind, "UChar")) return "uint8";
  const int bytes = std::atoi(precision.c_str());
  return fmt::format("{}int{}", same_word(kind, "UInt") ? "u" : "", 8 * bytes);
}

std::vector<double> DataItems::reals(const pugi::xml_node& item) { return numbers<double>(item); }

std::vector<std::int64_t> DataItems::integers(const pugi::xml_node& item) {
  return numbers<std::int64_t>(item);
}

template <typename T>
std::vector<T> DataItems::numbers(const pugi::xml_node& item) {
  if (++depth_ > kMostNesting) fail(item, "is nested too deeply");
  const std::string sort = item.attribute("ItemType").as_string("Uniform");
  const std::string format = item.attribute("Format").as_string("XML");
  std::vector<T> values;
  if (same_word(sort, "HyperSlab"))
    values = selected<T>(item);
  else if (same_word(sort, "Function"))
    values = joined<T>(item);
  else if (!same_word(sort, "Uniform"))
    fail(item, fmt::format("is of the type '{}' (Uniform, HyperSlab or Function expected)", sort));
  else if (same_word(format, "HDF") || same_word(format, "H5"))
    values = from_hdf5<T>(item);
  else if (same_word(format, "Binary"))
    values = from_binary<T>(item);
  else if (same_word(format, "XML"))
    values = from_text<T>(item);
  else
    fail(item, fmt::format("is in the format '{}' (XML, HDF or Binary expected)", format));
  --depth_;
  if (item.attribute("Dimensions") && values.size() != product(shape(item)))
    fail(item, fmt::format("holds {} numbers ({} expected)", values.size(), product(shape(item))));
  return values;
}

/// Selects by start, stride and count along every dimension of another item.
template <typename T>
std::vector<T> DataItems::selected(const pugi::xml_node& item) {
  const std::vector<std::int64_t> wanted = integers(item_in(item, 0));
  const pugi::xml_node source = item_in(item, 1);
  const std::vector<std::uint64_t> extents = shape(source);
  const std::size_t rank = extents.size();
  if (wanted.size() != 3 * rank) fail(item, "does not say start, stride and count of its source");
  for (std::size_t d = 0; d < rank; ++d) {
    const std::int64_t start = wanted[d];
    const std::int64_t stride = wanted[rank + d];
    const std::int64_t count = wanted[2 * rank + d];
    const auto extent = static_cast<std::int64_t>(extents[d]);
    if (start < 0 || stride < 1 || count < 1 || start >= extent ||
        (count - 1) > (extent - 1 - start) / stride)
      fail(item, "reaches beyond its source");
  }
  const std::vector<T> all = numbers<T>(source);
  std::vector<T> values;
  std::vector<std::int64_t> at(rank, 0);
  while (true) {
    std::size_t place = 0;
    for (std::size_t d = 0; d < rank; ++d)
      place = place * extents[d] + static_cast<std::size_t>(wanted[d] + at[d] * wanted[rank + d]);
    values.push_back(all[place]);
    std::size_t d = rank;
    while (d > 0 && ++at[d - 1] == wanted[2 * rank + d - 1]) at[--d] = 0;
    if (d == 0) return values;
  }
}

/// JOIN($0, $1, $2): tuples of the values of other items; of a single item, its values.
template <typename T>
std::vector<T> DataItems::joined(const pugi::xml_node& item) {
  const std::string function = item.attribute("Function").as_string();
  std::string_view rest = function;
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  const bool join = rest.size() >= 4 && same_word(rest.substr(0, 4), "JOIN");
  if (join) rest.remove_prefix(4);
  std::vector<std::vector<T>> columns;
  while (!rest.empty()) {
    const char c = rest.front();
    rest.remove_prefix(1);
    if (c != '$') {
      if (is_blank(c) || c == '(' || c == ')' || (join && c == ';')) continue;
      fail(item, fmt::format("the function '{}' is not computed (JOIN expected)", function));
    }
    std::size_t number = 0;
    const auto [next, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (error != std::errc()) fail(item, fmt::format("'{}' is no function", function));
    rest.remove_prefix(static_cast<std::size_t>(next - rest.data()));
    columns.push_back(numbers<T>(item_in(item, number)));
  }
  if (columns.empty() || (!join && columns.size() > 1))
    fail(item, fmt::format("the function '{}' is not computed (JOIN expected)", function));
  for (const std::vector<T>& column : columns)
    if (column.size() != columns.front().size())
      fail(item, "joins items of different numbers of values");
  std::vector<T> values;
  for (std::size_t i = 0; i < columns.front().size(); ++i)
    for (const std::vector<T>& column : columns) values.push_back(column[i]);
  return values;
}

template <typename T>
std::vector<T> DataItems::from_text(const pugi::xml_node& item) const {
  std::vector<T> values;
  if (!parse_all(std::string_view(item.child_value()), values))
    fail(item, "holds a word that is no number of its type");
  return values;
}

std::string DataItems::beside(const std::string& name) const { return file_beside(path_, name); }

template <typename T>
std::vector<T> DataItems::from_hdf5(const pugi::xml_node& item) {
  const std::string place = stripped(item.child_value());
  const std::size_t colon = place.rfind(':');
  if (colon == std::string::npos) fail(item, fmt::format("'{}' names no FILE:/DATASET", place));
  const std::string name = beside(stripped(place.substr(0, colon).c_str()));
  auto& file = files_[name];
  if (!file) file = std::make_shared<hdf5::File>(name);
  std::string dataset = place.substr(colon + 1);
  if (!dataset.starts_with('/')) dataset = fmt::format("/{}", dataset);
  if constexpr (std::is_same_v<T, double>)
    return file->reals(dataset);
  else
    return file->integers(dataset);
}

template <typename T>
std::vector<T> DataItems::from_binary(const pugi::xml_node& item) const {
  const MappedFile file(beside(stripped(item.child_value())));
  const std::string stored = type(item);
  const Convert<T> convert = conversion_from<T>(stored);
  if (convert == nullptr) fail(item, fmt::format("holds numbers of the unknown type {}", stored));
  const std::size_t size = stored == "double" ? 8
                           : stored == "float"
                               ? 4
                               : std::stoul(stored.substr(stored.find('t') + 1)) / 8;
  const std::uint64_t seek = item.attribute("Seek").as_ullong(0);
  const std::uint64_t count = product(shape(item));
  if (seek > file.text().size() || count > (file.text().size() - seek) / size)
    fail(item, fmt::format("its binary file ends early ({} numbers from byte {} on expected, {} "
                           "bytes found)",
                           count, seek, file.text().size()));
  const std::string endian = item.attribute("Endian").as_string("Native");
  const bool swap = same_word(endian, "Big");
  std::vector<T> values(count);
  for (std::uint64_t i = 0; i < count; ++i)
    values[i] = convert(file.text().data() + seek + i * size, swap);
  return values;
}

}  // namespace hiac::formats::xdmf
