#include "hiac/mesh/parted/parted_index.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hiac/base/error.hpp"
#include "hiac/mesh/file_descriptor.hpp"

namespace hiac {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "hiac parted mesh";
constexpr std::uint64_t kPartsVersion = 1;
/// An index of kMostParts parts with long names has a tenth of it.
constexpr std::size_t kMostBytes = std::size_t{1} << 28;

std::string text_in(const std::string& path) {
  const FileDescriptor file = open_to_read(path);
  std::string text;
  std::vector<std::uint8_t> buffer(1 << 16);
  for (;;) {
    const std::size_t count = read_fully(file.number(), buffer, path);
    text.append(reinterpret_cast<const char*>(buffer.data()), count);
    if (count < buffer.size()) return text;
    if (text.size() > kMostBytes)
      throw InputError(path, fmt::format("is too large for the index of a parted mesh (at most {} "
                                         "bytes expected)",
                                         kMostBytes));
  }
}

/// Takes the members of a JSON object by name; `where` says in messages which object it is.
class Members {
 public:
  Members(const Json& object, const std::string& path, std::string where)
      : object_(object), path_(path), where_(std::move(where)) {
    if (!object_.is_object()) fail("a JSON object expected");
  }

  [[nodiscard]] std::uint64_t count(const char* name) const {
    const Json& value = member(name);
    if (!value.is_number_unsigned()) fail(fmt::format("\"{}\": a whole number expected", name));
    return value.get<std::uint64_t>();
  }
  [[nodiscard]] std::string text(const char* name) const {
    const Json& value = member(name);
    if (!value.is_string()) fail(fmt::format("\"{}\": a text expected", name));
    return value.get<std::string>();
  }
  /// 32 hexadecimal digits.
  [[nodiscard]] std::string hash(const char* name) const {
    std::string value = text(name);
    const auto is_digit = [](char c) { return ('0' <= c && c <= '9') || ('a' <= c && c <= 'f'); };
    if (value.size() != 32 || !std::ranges::all_of(value, is_digit))
      fail(fmt::format("\"{}\": 32 hexadecimal digits expected", name));
    return value;
  }
  [[nodiscard]] std::array<double, 3> corner(const char* name) const {
    const Json& value = member(name);
    std::array<double, 3> xyz{};
    if (!value.is_array() || value.size() != 3)
      fail(fmt::format("\"{}\": three numbers expected", name));
    for (std::size_t i = 0; i < 3; ++i) {
      if (!value[i].is_number() || !std::isfinite(value[i].get<double>()))
        fail(fmt::format("\"{}\": three finite numbers expected", name));
      xyz[i] = value[i].get<double>();
    }
    return xyz;
  }
  [[nodiscard]] const Json& list(const char* name) const {
    const Json& value = member(name);
    if (!value.is_array()) fail(fmt::format("\"{}\": a list expected", name));
    return value;
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(path_, where_ + message);
  }

 private:
  [[nodiscard]] const Json& member(const char* name) const {
    const auto found = object_.find(name);
    if (found == object_.end()) fail(fmt::format("\"{}\" is missing", name));
    return *found;
  }

  const Json& object_;
  const std::string& path_;
  std::string where_;
};

void check_file_name(const std::string& file, PartFiles files, const Members& members) {
  if (file.empty()) members.fail("\"file\" is empty (a file's name expected)");
  if (std::ranges::any_of(file, [](unsigned char c) { return std::iscntrl(c) != 0; }))
    members.fail("\"file\" has control characters");
  const auto name = std::filesystem::path(file).lexically_normal();
  if (files == PartFiles::beside && (name.is_absolute() || *name.begin() == ".."))
    members.fail(
        fmt::format("names {}, which lies outside the index's folder "
                    "(PartFiles::anywhere reads it)",
                    file));
}

PartInfo part_in(const Json& object, std::size_t number, const std::string& path, PartFiles files) {
  const Members members(object, path, fmt::format("part {}: ", number));
  PartInfo part{members.text("file"),        members.count("cells"), members.count("nodes"),
                members.corner("low"),       members.corner("high"), members.hash("hash"),
                members.hash("numbers_hash")};
  check_file_name(part.file, files, members);
  if (part.cells == 0 || part.nodes == 0)
    members.fail(fmt::format("is empty (cells and nodes expected, {} and {} found)", part.cells,
                             part.nodes));
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (part.low[axis] > part.high[axis])
      members.fail(fmt::format("an impossible box ({} from {} to {})", "xyz"[axis], part.low[axis],
                               part.high[axis]));
  return part;
}

/// What the parts together have to be.
void check_sums(const PartedIndex& index) {
  std::uint64_t cells = 0, nodes = 0;
  std::set<std::string> files;
  for (std::size_t k = 0; k < index.parts.size(); ++k) {
    const PartInfo& part = index.parts[k];
    if (!files.insert(std::filesystem::path(part.file).lexically_normal().string()).second)
      throw InputError(index.path, fmt::format("part {}: its file {} is that of another part, too",
                                               k, part.file));
    if (part.nodes > index.nodes)
      throw InputError(index.path, fmt::format("part {}: more nodes than the whole mesh (at most "
                                               "{} expected, {} found)",
                                               k, index.nodes, part.nodes));
    // no sum overflows, as none goes on beyond the whole
    if (part.cells > index.cells - cells)
      throw InputError(index.path, fmt::format("the parts have more cells than the whole mesh ({} "
                                               "expected)",
                                               index.cells));
    cells += part.cells;
    nodes = std::min(index.nodes, nodes + part.nodes);
  }
  if (cells != index.cells)
    throw InputError(index.path, fmt::format("the parts' cells are not those of the whole mesh ({} "
                                             "expected, {} found)",
                                             index.cells, cells));
  if (nodes < index.nodes)
    throw InputError(index.path, fmt::format("the parts have fewer nodes than the whole mesh ({} "
                                             "expected, {} found)",
                                             index.nodes, nodes));
}

Json parsed(const std::string& path) {
  try {
    return Json::parse(text_in(path));
  } catch (const Json::parse_error& error) {
    throw InputError(path, fmt::format("is not the index of a parted mesh (JSON expected, which "
                                       "is broken at byte {})",
                                       error.byte));
  }
}

}  // namespace

std::string PartedIndex::path_of(std::size_t part) const {
  return (std::filesystem::path(path).parent_path() / parts[part].file).string();
}

bool is_parted_index(std::string_view head) {
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && head[first] == '{' &&
         head.find(fmt::format("\"{}\"", kFormat)) != std::string_view::npos;
}

PartedIndex read_parted_index(const std::string& path, PartFiles files) {
  const Json json = parsed(path);
  const Members members(json, path, "");
  if (members.text("format") != kFormat)
    members.fail(
        fmt::format("is not the index of a parted mesh (\"format\": \"{}\" expected)", kFormat));
  if (const std::uint64_t version = members.count("version"); version != kPartsVersion)
    members.fail(fmt::format("unknown version of the parted mesh ({} expected, {} found)",
                             kPartsVersion, version));
  PartedIndex index{path, members.count("cells"), members.count("nodes"), members.hash("hash"), {}};
  const Json& parts = members.list("parts");
  if (parts.empty() || parts.size() > kMostParts)
    members.fail(fmt::format("impossible number of parts (1 to {} expected, {} found)", kMostParts,
                             parts.size()));
  for (const Json& part : parts)
    index.parts.push_back(part_in(part, index.parts.size(), path, files));
  check_sums(index);
  return index;
}

std::string text_of(const PartedIndex& index) {
  Json json{{"format", kFormat},    {"version", kPartsVersion}, {"cells", index.cells},
            {"nodes", index.nodes}, {"hash", index.hash},       {"parts", Json::array()}};
  for (const PartInfo& part : index.parts)
    json["parts"].push_back({{"file", part.file},
                             {"cells", part.cells},
                             {"nodes", part.nodes},
                             {"low", part.low},
                             {"high", part.high},
                             {"hash", part.hash},
                             {"numbers_hash", part.numbers_hash}});
  return json.dump(1) + "\n";
}

}  // namespace hiac
