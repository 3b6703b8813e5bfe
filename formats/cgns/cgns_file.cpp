#include "formats/cgns/cgns_file.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>

#include <cgns_io.h>
#include <fmt/format.h>

#include "formats/common/io/named_file.hpp"
#include "formats/hdf5/external_files.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::cgns {
namespace {

constexpr std::size_t kMostCompression = 1100;
constexpr std::size_t kMostChildren = 1 << 20;

std::size_t bytes_of(const std::string& type) {
  if (type == "C1" || type == "B1" || type == "U1" || type == "I1") return 1;
  if (type == "I4" || type == "U4" || type == "R4") return 4;
  if (type == "I8" || type == "U8" || type == "R8") return 8;
  return 0;
}

template <typename Stored, typename T>
std::vector<T> converted(const std::vector<char>& bytes) {
  std::vector<T> values(bytes.size() / sizeof(Stored));
  for (std::size_t i = 0; i < values.size(); ++i) {
    Stored value{};
    std::memcpy(&value, bytes.data() + i * sizeof value, sizeof value);
    values[i] = static_cast<T>(value);
  }
  return values;
}

template <typename T>
std::vector<T> numbers(const std::string& type, const std::vector<char>& bytes) {
  if (type == "I4") return converted<std::int32_t, T>(bytes);
  if (type == "U4") return converted<std::uint32_t, T>(bytes);
  if (type == "I8") return converted<std::int64_t, T>(bytes);
  if (type == "U8") return converted<std::uint64_t, T>(bytes);
  if (type == "R4") return converted<float, T>(bytes);
  if (type == "R8") return converted<double, T>(bytes);
  return {};
}

}  // namespace

CgnsFile::CgnsFile(const std::string& path) : path_(path) {
  std::error_code failed;
  file_size_ = std::filesystem::file_size(path, failed);
  if (failed) throw InputError(path, fmt::format("cannot be read ({})", failed.message()));
  int sort = CGIO_FILE_NONE;
  if (cgio_check_file(path.c_str(), &sort) != 0)
    throw InputError(path, "is no whole CGNS file (the library cannot open it)");
  packed_ = sort == CGIO_FILE_HDF5;
  if (packed_) hdf5::require_local_links(path);
  if (cgio_open_file(path.c_str(), CGIO_MODE_READ, sort, &file_) != 0)
    throw InputError(path, "is no whole CGNS file (the library cannot open it)");
}

CgnsFile::~CgnsFile() { cgio_close_file(file_); }

void CgnsFile::fail(const Node& node, const std::string& problem) const {
  throw InputError(path_, fmt::format("{} '{}': {}", node.label, node.name, problem));
}

void CgnsFile::require_local_link(double id) const {
  int length = 0;
  if (cgio_is_link(file_, id, &length) != 0 || length <= 0) return;
  int file_length = 0, name_length = 0;
  if (cgio_link_size(file_, id, &file_length, &name_length) != 0 || file_length <= 0) return;
  std::string file(static_cast<std::size_t>(file_length) + 1, '\0');
  std::string name(static_cast<std::size_t>(std::max(name_length, 0)) + 1, '\0');
  if (cgio_get_link(file_, id, file.data(), name.data()) != 0) return;
  file.resize(std::min(file.find('\0'), file.size()));
  if (!file.empty()) file_beside(path_, file);
}

Node CgnsFile::node_at(double id) const {
  require_local_link(id);
  std::array<char, CGIO_MAX_NAME_LENGTH + 1> name{};
  std::array<char, CGIO_MAX_LABEL_LENGTH + 1> label{};
  std::array<char, CGIO_MAX_DATATYPE_LENGTH + 1> type{};
  std::array<cgsize_t, CGIO_MAX_DIMENSIONS> extents{};
  int rank = 0;
  if (cgio_get_name(file_, id, name.data()) != 0 || cgio_get_label(file_, id, label.data()) != 0 ||
      cgio_get_data_type(file_, id, type.data()) != 0 ||
      cgio_get_dimensions(file_, id, &rank, extents.data()) != 0 || rank < 0 ||
      rank > CGIO_MAX_DIMENSIONS)
    throw InputError(path_, "has a damaged node");
  Node node{id, name.data(), label.data(), type.data(), {}};
  for (int d = 0; d < rank; ++d) {
    const cgsize_t extent = extents[static_cast<std::size_t>(d)];
    if (extent < 0) fail(node, fmt::format("has a negative extent ({})", extent));
    node.shape.push_back(static_cast<std::size_t>(extent));
  }
  return node;
}

Node CgnsFile::root() const {
  double id = 0;
  if (cgio_get_root_id(file_, &id) != 0) throw InputError(path_, "has no root node");
  return {id, "/", "root", "MT", {}};
}

std::vector<Node> CgnsFile::children(const Node& node, std::string_view label) const {
  int count = 0;
  if (cgio_number_children(file_, node.id, &count) != 0 || count < 0 ||
      static_cast<std::size_t>(count) > kMostChildren)
    fail(node, "cannot be listed");
  std::vector<double> ids(static_cast<std::size_t>(count));
  int found = 0;
  if (count > 0 && cgio_children_ids(file_, node.id, 1, count, &found, ids.data()) != 0)
    fail(node, "cannot be listed");
  std::vector<Node> result;
  for (int i = 0; i < std::min(found, count); ++i) {
    Node next = node_at(ids[static_cast<std::size_t>(i)]);
    if (label.empty() || next.label == label) result.push_back(std::move(next));
  }
  return result;
}

std::optional<Node> CgnsFile::child(const Node& node, std::string_view name) const {
  for (Node& next : children(node))
    if (next.name == name) return std::move(next);
  return std::nullopt;
}

std::optional<Node> CgnsFile::labelled(const Node& node, std::string_view label) const {
  std::vector<Node> found = children(node, label);
  if (found.empty()) return std::nullopt;
  return std::move(found.front());
}

std::vector<char> CgnsFile::bytes(const Node& node) const {
  std::size_t size = bytes_of(node.type);
  const std::size_t most = file_size_ * (packed_ ? kMostCompression : 1);
  if (size == 0)
    fail(node, fmt::format("holds data of type '{}' (numbers or text expected)", node.type));
  for (const std::size_t extent : node.shape)
    if (__builtin_mul_overflow(size, extent, &size) || size > most)
      fail(node, fmt::format("declares more than a file of {} bytes can hold", file_size_));
  std::vector<char> data(size);
  if (size > 0 && cgio_read_all_data(file_, node.id, data.data()) != 0)
    fail(node, "cannot be read");
  return data;
}

std::vector<double> CgnsFile::reals(const Node& node) const {
  return numbers<double>(node.type, bytes(node));
}

std::vector<std::int64_t> CgnsFile::integers(const Node& node) const {
  if (!node.type.starts_with('I') && !node.type.starts_with('U'))
    fail(node, fmt::format("is of type '{}' (whole numbers expected)", node.type));
  return numbers<std::int64_t>(node.type, bytes(node));
}

std::string CgnsFile::text(const Node& node) const {
  if (node.type != "C1") fail(node, fmt::format("is of type '{}' (text expected)", node.type));
  const std::vector<char> data = bytes(node);
  return {data.begin(), data.end()};
}

}  // namespace hiac::formats::cgns
