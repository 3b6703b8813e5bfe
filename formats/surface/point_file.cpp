#include "formats/surface/point_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "formats/surface/plain_number.hpp"
#include "formats/surface/tetgen_text.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

// Points row by row: x, y, z and the fields.
struct PointTable {
  std::vector<std::string> names;  // of the columns, coordinates included
  std::vector<double> values;
};

std::vector<std::string> words_of(std::string line) {
  for (char& c : line)
    if (c == ',' || c == ';' || c == '"' || c == '\r') c = ' ';
  std::istringstream text(line);
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> default_names(std::size_t count) {
  std::vector<std::string> names{"x", "y", "z"};
  for (std::size_t k = 3; k < count; ++k)
    names.push_back(count == 4 ? "value" : fmt::format("value{}", k - 2));
  return names;
}

PointTable read_table(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path, fmt::format("cannot be opened ({})", std::strerror(errno)));
  PointTable table;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::vector<std::string> words = words_of(line);
    if (words.empty() || words[0].starts_with('#')) continue;
    const std::string at = fmt::format("{}:{}", path, number);
    if (table.names.empty()) {
      const bool numbers =
          std::ranges::all_of(words, [](const auto& w) { return plain_number(w).has_value(); });
      table.names = numbers ? default_names(words.size()) : words;
      if (table.names.size() < 3 || words.size() < 3)
        throw InputError(at, fmt::format("at least 3 columns expected ({} found)", words.size()));
      if (!numbers) continue;
    }
    if (words.size() != table.names.size())
      throw InputError(
          at, fmt::format("{} columns expected ({} found)", table.names.size(), words.size()));
    for (const std::string& word : words) {
      const auto value = plain_number(word);
      if (!value) throw InputError(at, fmt::format("a number expected ('{}' found)", word));
      table.values.push_back(*value);
    }
  }
  return table;
}

PointTable read_node_table(const std::string& path) {
  TetgenLines lines(path);
  const TetgenNodes nodes = read_tetgen_nodes(lines);
  PointTable table{default_names(3 + nodes.attribute_count), {}};
  for (std::size_t i = 0; i < nodes.points.size(); ++i) {
    table.values.insert(table.values.end(), nodes.points[i].begin(), nodes.points[i].end());
    const auto first =
        nodes.attributes.begin() + static_cast<std::ptrdiff_t>(i * nodes.attribute_count);
    table.values.insert(table.values.end(), first,
                        first + static_cast<std::ptrdiff_t>(nodes.attribute_count));
  }
  return table;
}

// The columns of x, y and z: by name, in any case, or the first three if no column has such a name.
std::array<std::size_t, 3> coordinate_columns(const PointTable& table) {
  std::array<std::size_t, 3> columns{0, 1, 2};
  std::array<std::size_t, 3> named{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto at = std::ranges::find_if(table.names, [&](const std::string& name) {
      return name.size() == 1 && std::tolower(static_cast<unsigned char>(name[0])) == "xyz"[c];
    });
    if (at == table.names.end()) return columns;
    named[c] = static_cast<std::size_t>(at - table.names.begin());
  }
  return named;
}

}  // namespace

bool is_point_file(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension == ".csv" || extension == ".txt" || extension == ".xyz" || extension == ".node";
}

ZooMesh read_points(const std::string& path) {
  const bool tetgen = std::filesystem::path(path).extension() == ".node";
  const PointTable table = tetgen ? read_node_table(path) : read_table(path);
  const std::size_t width = table.names.size();
  if (table.values.empty()) throw InputError(path, "holds no point");
  const std::size_t count = table.values.size() / width;
  if (count >= std::numeric_limits<NodeId>::max())
    throw InputError(path, fmt::format("holds {} points (at most 2^32 - 2 expected)", count));
  const std::array<std::size_t, 3> xyz = coordinate_columns(table);
  std::vector<double> positions;
  positions.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i)
    for (const std::size_t column : xyz) {
      const double value = table.values[i * width + column];
      if (!std::isfinite(value))
        throw InputError(path, fmt::format("a coordinate of point {} is not finite", i));
      positions.push_back(value);
    }
  ZooMesh mesh;
  mesh.elems = std::vector<std::uint64_t>{0};
  mesh.xyz = std::move(positions);
  for (std::size_t column = 0; column < width; ++column) {
    if (std::ranges::find(xyz, column) != xyz.end()) continue;
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = table.values[i * width + column];
    mesh.fields.push_back({table.names[column], "", FieldLocation::node, 1, std::move(values)});
  }
  return mesh;
}

}  // namespace hiac::formats
