#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/registry.hpp"
#include "hiac/base/error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac::formats {

/// The folder of real files: HIAC_DATA_DIR, or shared/data beside the source folder.
inline std::string data_dir() {
  const char* named = std::getenv("HIAC_DATA_DIR");
  return named != nullptr ? named : HIAC_DEFAULT_DATA_DIR;
}

using test::ScratchFolder;

inline std::string text_of(const std::string& path) { return test::bytes_of(path); }

inline Reading read_any(const std::string& path, const ReadOptions& options = {}) {
  return format_to_read(path).read(path, options);
}

/// The message of the InputError that reading throws; empty when it throws none.
inline std::string refusal(const std::string& path, const ReadOptions& options = {}) {
  try {
    read_any(path, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// A legacy file of one cell.
inline std::string one_cell_file(const std::string& points, std::size_t point_count,
                                 const std::string& nodes, std::size_t node_count, int type) {
  std::ostringstream text;
  text << "# vtk DataFile Version 3.0\none cell\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
       << point_count << " double\n"
       << points << "\nCELLS 1 " << node_count + 1 << "\n"
       << node_count << " " << nodes << "\nCELL_TYPES 1\n"
       << type << "\n";
  return text.str();
}

}  // namespace hiac::formats
