#include "hiac/base/large_pages.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace hiac {
namespace {

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

TEST(LargePages, UnsetArraysHoldWhatIsWritten) {
  const std::size_t count = (std::size_t{1} << 23) + 1;
  const auto elements = unset_array<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i) elements[i] = static_cast<std::uint32_t>(3 * i);
  for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(elements[i], static_cast<std::uint32_t>(3 * i));
}

}  // namespace
}  // namespace hiac
