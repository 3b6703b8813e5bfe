#include "hiac/base/large_pages.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mman.h>

namespace hiac {
namespace {

constexpr std::size_t kLargePage = std::size_t{1} << 21;

/// Whether the system was asked for large pages at an address: the flag "hg" of the mapping that
/// holds it. Nothing where no mapping does, or the system tells no flags.
std::optional<bool> advised(const void* address) {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream maps("/proc/self/smaps");
  bool here = false;
  for (std::string line; std::getline(maps, line);) {
    std::uintptr_t begin = 0, end = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx ", &begin, &end) == 2) here = begin <= at && at < end;
    if (here && line.starts_with("VmFlags:")) return line.find(" hg") != std::string::npos;
  }
  return std::nullopt;
}

/// Fresh memory from the beginning of a large page on, given back afterwards.
class Mapping {
 public:
  explicit Mapping(std::size_t pages) : bytes_((pages + 1) * kLargePage) {
    memory_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  }
  ~Mapping() { munmap(memory_, bytes_); }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  [[nodiscard]] unsigned char* begin() const {
    const auto address = reinterpret_cast<std::uintptr_t>(memory_);
    return static_cast<unsigned char*>(memory_) + (kLargePage - address % kLargePage) % kLargePage;
  }

 private:
  std::size_t bytes_;
  void* memory_;
};

/// Whether this system takes the advice and says so.
bool system_takes_advice() {
#ifdef MADV_HUGEPAGE
  const Mapping mapping(4);
  return madvise(mapping.begin(), 2 * kLargePage, MADV_HUGEPAGE) == 0 &&
         advised(mapping.begin()).value_or(false);
#else
  return false;
#endif
}

TEST(LargePages, WholePagesInsideAnArrayAreAskedFor) {
  if (!system_takes_advice()) GTEST_SKIP() << "this system has no large pages";
  const Mapping mapping(16);
  unsigned char* const begin = mapping.begin();
  // from within a page on to within another: neither of the two
  advise_large_pages(begin + 100, 10 * kLargePage);
  EXPECT_EQ(advised(begin), false);
  EXPECT_EQ(advised(begin + kLargePage - 4096), false);
  EXPECT_EQ(advised(begin + kLargePage), true);
  EXPECT_EQ(advised(begin + 10 * kLargePage - 4096), true);
  EXPECT_EQ(advised(begin + 10 * kLargePage), false);
}

TEST(LargePages, SmallArraysAreLeftAlone) {
  if (!system_takes_advice()) GTEST_SKIP() << "this system has no large pages";
  const Mapping mapping(16);
  advise_large_pages(mapping.begin(), 8 * kLargePage - 1);
  EXPECT_EQ(advised(mapping.begin() + 2 * kLargePage), false);
  advise_large_pages(mapping.begin(), 8 * kLargePage);
  EXPECT_EQ(advised(mapping.begin() + 2 * kLargePage), true);
}

TEST(LargePages, LargeVectorsAndUnsetArraysAskForThem) {
  if (!system_takes_advice()) GTEST_SKIP() << "this system has no large pages";
  const std::size_t count = 16 * kLargePage / sizeof(std::uint32_t);
  const auto vector = large_vector<std::uint32_t>(count);
  EXPECT_EQ(advised(vector.data() + count / 2), true);
  const auto array = unset_array<std::uint32_t>(count);
  EXPECT_EQ(advised(array.get() + count / 2), true);
}

TEST(LargePages, VectorsAreZeroAtAnySize) {
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, std::size_t{1} << 20, (std::size_t{1} << 23) + 5}) {
    const auto elements = large_vector<std::uint32_t>(count);
    EXPECT_EQ(elements.size(), count);
    EXPECT_TRUE(std::ranges::all_of(elements, [](std::uint32_t e) { return e == 0; }));
  }
}

TEST(LargePages, AdviceKeepsContents) {
  std::vector<std::uint32_t> elements(std::size_t{1} << 23);
  for (std::size_t i = 0; i < elements.size(); ++i) elements[i] = static_cast<std::uint32_t>(i);
  // from addresses that begin and end within pages
  advise_large_pages(elements.data() + 3, (elements.size() - 9) * sizeof(std::uint32_t));
  for (std::size_t i = 0; i < elements.size(); ++i)
    ASSERT_EQ(elements[i], static_cast<std::uint32_t>(i));
  advise_large_pages(nullptr, 0);
}

}  // namespace
}  // namespace hiac
