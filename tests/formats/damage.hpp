#pragma once

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>

#include "hiac/mesh/zoo_mesh.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {

/// Reads; anything but a valid mesh, an InputError of one line or a UsageError fails the test.
/// Returns whether the file was refused.
inline bool expect_refused_or_valid(const std::string& path) {
  try {
    const Reading reading = read_any(path);
    EXPECT_NO_THROW(validate(reading.mesh, path));
    return false;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  } catch (const UsageError&) {
  }
  return true;
}

/// The file at `path`, cut off at `parts` places. Returns how many of them were refused.
inline std::size_t expect_cuts_survived(const std::string& path, std::size_t parts) {
  const ScratchFolder folder;
  const std::string text = text_of(path);
  const std::string extension = std::filesystem::path(path).extension().string();
  std::size_t refused = 0;
  for (std::size_t part = 0; part < parts; ++part)
    refused += expect_refused_or_valid(
                   folder.write("cut" + extension, text.substr(0, text.size() * part / parts)))
                   ? 1
                   : 0;
  return refused;
}

/// The file at `path` with changed bytes, most of them in its head; HIAC_DAMAGE_FACTOR multiplies
/// the trials.
inline void expect_changes_survived(const std::string& path, int trials) {
  const ScratchFolder folder;
  const char* asked = std::getenv("HIAC_DAMAGE_FACTOR");
  std::mt19937 random(20240101);  // NOLINT(cert-msc51-cpp): the same files every time
  const std::string text = text_of(path);
  const std::string extension = std::filesystem::path(path).extension().string();
  for (int trial = 0; trial < trials * (asked == nullptr ? 1 : std::atoi(asked)); ++trial) {
    std::string changed = text;
    for (std::size_t left = 1 + random() % 4; left > 0; --left) {
      const std::size_t reach =
          random() % 3 == 0 ? changed.size() : std::min<std::size_t>(changed.size(), 8192);
      changed[random() % reach] = static_cast<char>(random() % 3 == 0 ? 255 : random() % 256);
    }
    expect_refused_or_valid(folder.write("changed" + extension, changed));
  }
}

}  // namespace hiac::formats
