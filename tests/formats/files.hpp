#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "formats/registry.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {

/// The folder of real files: HIAC_DATA_DIR, or shared/data beside the source folder.
inline std::string data_dir() {
  const char* named = std::getenv("HIAC_DATA_DIR");
  return named != nullptr ? named : HIAC_DEFAULT_DATA_DIR;
}

/// A folder for one test's files, gone afterwards.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "hiac-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no scratch folder");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
    return file(name);
  }

 private:
  std::filesystem::path path_;
};

inline std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

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
