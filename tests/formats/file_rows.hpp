#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "tests/formats/files.hpp"

namespace hiac::formats {

struct FieldRow {
  std::string name;
  std::string location;
  std::uint32_t components;
  double low;
  double high;
};

/// A row of the table of real files: points, cells by kind, fields with their ranges (at the last
/// step), steps.
struct FileRow {
  std::string path;
  std::size_t points;
  std::map<CellKind, std::size_t> cells;
  std::vector<FieldRow> fields;
  std::size_t steps = 0;
  std::size_t nodes = 0;  ///< of the mesh, where cells do not use every point
  bool corners = false;   ///< its kinds are beyond the zoo: their corners are read
};

inline std::ostream& operator<<(std::ostream& out, const FileRow& row) { return out << row.path; }

/// A name for a test of that row.
inline std::string row_name(const testing::TestParamInfo<FileRow>& row) {
  std::string name = row.param.path;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return row.param.corners ? name + "_corners" : name;
}

/// The table gives five digits.
inline void expect_five_digits(double found, double expected, const std::string& what) {
  EXPECT_NEAR(found, expected, 1e-4 * std::abs(expected)) << what;
}

/// The file at `path` holds what the row says.
inline void expect_row(const FileRow& row, const std::string& path) {
  const Format& format = format_to_read(path);
  const Inventory inventory = format.inspect(path);
  EXPECT_EQ(inventory.points, row.points);
  EXPECT_EQ(inventory.times.size(), row.steps);
  for (const FieldRow& field : row.fields) {
    const auto found = std::find_if(
        inventory.fields.begin(), inventory.fields.end(), [&](const FieldSummary& other) {
          return other.name == field.name && other.location == field.location;
        });
    ASSERT_NE(found, inventory.fields.end()) << field.name;
    EXPECT_EQ(found->components, field.components) << field.name;
    expect_five_digits(found->low, field.low, field.name);
    expect_five_digits(found->high, field.high, field.name);
  }
  ReadOptions options;
  options.corners_of_unsupported = row.corners;
  const Reading reading = format.read(path, options);
  std::map<CellKind, std::size_t> cells;
  for (const CellKind kind : reading.mesh.kinds) ++cells[kind];
  EXPECT_EQ(cells, row.cells);
  EXPECT_EQ(reading.mesh.node_count(), row.nodes == 0 ? row.points : row.nodes);
  EXPECT_EQ(reading.mesh.fields.size(), inventory.fields.size());
  EXPECT_NO_THROW(validate(reading.mesh, path));
}

}  // namespace hiac::formats
