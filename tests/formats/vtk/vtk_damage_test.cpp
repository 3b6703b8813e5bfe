// Files cut off and files with changed bytes: a clear refusal or a correct mesh, no crash, and no
// memory for what a file merely declares.
#include <algorithm>
#include <random>

#include <fmt/format.h>

#include "tests/formats/files.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac::formats {
namespace {

std::vector<std::string> vtk_files() {
  std::vector<std::string> files;
  if (!std::filesystem::exists(data_dir())) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data_dir())) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".vtk" || extension == ".vtu" || extension == ".vts")
      files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// A line of /proc/self/status, in bytes.
std::size_t status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key + ":")) return std::stoul(line.substr(key.size() + 1)) * 1024;
  return 0;
}

/// The most memory that `work` had beyond what there was before it.
template <typename Work>
std::size_t peak_memory_of(const Work& work) {
  std::ofstream("/proc/self/clear_refs") << "5";
  const std::size_t before = status_bytes("VmRSS");
  work();
  const std::size_t peak = status_bytes("VmHWM");
  return peak > before ? peak - before : 0;
}

/// Reads; says whether it was refused. Anything but an InputError with one line fails the test.
bool is_refused(const std::string& path) {
  const std::string message = refusal(path);
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  return !message.empty();
}

TEST(VtkDamage, TruncatedFilesAreRefusedOrWhole) {
  const ScratchFolder folder;
  const std::vector<std::string> files = vtk_files();
  if (files.empty()) GTEST_SKIP() << "no data";
  for (const std::string& path : files) {
    const std::string text = text_of(path);
    const std::string extension = std::filesystem::path(path).extension().string();
    const bool xml = text.find("<VTKFile") != std::string::npos;
    for (std::size_t cut = 0; cut < 20; cut += test::kInstrumented ? 4 : 1) {
      // the last cuts near the end, where little is missing
      const std::size_t length = cut < 16 ? text.size() * cut / 16 : text.size() - (cut - 15) * 7;
      const std::string part =
          folder.write("part" + extension, text.substr(0, std::min(length, text.size())));
      bool refused = false;
      const std::size_t memory = peak_memory_of([&] { refused = is_refused(part); });
      EXPECT_TRUE(refused || !xml) << path << " cut to " << length;
      EXPECT_LE(memory, 2 * text.size() + (std::size_t{48} << 20)) << path << " cut to " << length;
    }
  }
}

// A legacy file has no end mark: cut between two arrays it is a file with fewer arrays. What is
// read of a cut file must be what the whole file has.
TEST(VtkDamage, WhatIsReadOfATruncatedLegacyFileIsRight) {
  const ScratchFolder folder;
  const std::string path = data_dir() + "/vtk_legacy/versions/data_3_3_tets.vtk";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const std::string text = text_of(path);
  const ZooMesh whole = read_any(path).mesh;
  std::size_t read = 0;
  for (std::size_t length = 1; length < text.size(); ++length) {
    if (text[length - 1] != '\n') continue;  // else the last number may be cut: see the note
    const std::string part = folder.write("part.vtk", text.substr(0, length));
    if (is_refused(part)) continue;
    ++read;
    const ZooMesh mesh = read_any(part).mesh;
    ASSERT_TRUE(std::equal(mesh.xyz.begin(), mesh.xyz.end(), whole.xyz.begin(), whole.xyz.end()));
    for (const Field& field : mesh.fields) {
      const auto same = std::find_if(whole.fields.begin(), whole.fields.end(),
                                     [&](const Field& f) { return f.name == field.name; });
      ASSERT_NE(same, whole.fields.end());
      EXPECT_TRUE(std::equal(field.values.begin(), field.values.end(), same->values.begin(),
                             same->values.end()));
    }
  }
  EXPECT_GT(read, 2U);
  const std::string cut =
      folder.write("cut.vtk", text.substr(0, text.find_last_of("0123456789") + 1));
  EXPECT_THAT(read_any(cut).notes, testing::Contains(testing::HasSubstr("line end")));
}

TEST(VtkDamage, ChangedBytesAreSurvived) {
  const ScratchFolder folder;
  const std::vector<std::string> files = vtk_files();
  if (files.empty()) GTEST_SKIP() << "no data";
  // for a longer search than every run of the tests can afford
  const char* asked = std::getenv("HIAC_DAMAGE_FACTOR");
  const std::size_t factor = asked == nullptr ? 1 : std::strtoul(asked, nullptr, 10);
  std::mt19937 random(20240101);  // NOLINT(cert-msc51-cpp): the same files every time
  const auto below = [&](std::size_t n) { return random() % std::max<std::size_t>(n, 1); };
  for (const std::string& path : files) {
    const std::string text = text_of(path);
    const std::string extension = std::filesystem::path(path).extension().string();
    const std::size_t trials = factor * test::tried(text.size() < 10'000    ? 60
                                                    : text.size() < 200'000 ? 20
                                                                            : 4);
    for (std::size_t trial = 0; trial < trials; ++trial) {
      std::string changed = text;
      const std::size_t changes = 1 + below(3);
      for (std::size_t c = 0; c < changes; ++c) {
        // headers most of the time, and digits with larger ones, which declare more
        const std::size_t header = std::min<std::size_t>(changed.size(), 1500);
        const std::size_t reach = below(4) == 0 ? changed.size() : header;
        const std::size_t at = below(reach);
        const bool digit = std::isdigit(static_cast<unsigned char>(changed[at])) != 0;
        changed[at] = digit && below(2) == 0 ? '9' : static_cast<char>(below(256));
        if (digit && below(4) == 0) changed.insert(at, "99999999");
      }
      const std::string file = folder.write("changed" + extension, changed);
      const std::size_t memory = peak_memory_of([&] { is_refused(file); });
      EXPECT_LE(memory, 8 * text.size() + (std::size_t{64} << 20)) << path << ", trial " << trial;
    }
  }
}

}  // namespace
}  // namespace hiac::formats
