#include "tools/common/steps/number_pattern.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac::tools {
namespace {

TEST(NumberPattern, GivesEveryNumberAName) {
  EXPECT_EQ(NumberPattern("-o", "run-%04d.zoo").path_of(7), "run-0007.zoo");
  EXPECT_EQ(NumberPattern("-o", "run-%04d.zoo").path_of(12345), "run-12345.zoo");
  EXPECT_EQ(NumberPattern("-o", "a/%d").path_of(0), "a/0");
  EXPECT_EQ(NumberPattern("-o", "%2d.vtu").path_of(3), "03.vtu");
}

TEST(NumberPattern, RefusesAllButOnePlace) {
  for (const char* text :
       {"run.zoo", "%d-%d.zoo", "%s.zoo", "%x-%d.zoo", "100%-%d.zoo", "%%%d.zoo", "%-4d.zoo",
        "%4.2f.zoo", "%9999d.zoo", "%i.zoo", "%*d.zoo", "%d%", "%", "%ld.zoo", ""})
    EXPECT_THROW(NumberPattern("-o", text), UsageError) << text;
}

TEST(NumberPattern, FindsTheFilesThatItNames) {
  const test::ScratchFolder folder;
  for (const char* name :
       {"run-0010.zoo", "run-0002.zoo", "run-12345.zoo", "run-3.zoo", "run-00004.zoo", "run-.zoo",
        "run-0005.zoo~", "xrun-0006.zoo", "run-+007.zoo", "run-0008a.zoo"})
    (void)folder.write(name, "");
  using Numbers = std::vector<std::size_t>;
  EXPECT_EQ(NumberPattern("MESH", folder.file("run-%04d.zoo")).existing(), (Numbers{2, 10, 12345}));
  EXPECT_EQ(NumberPattern("MESH", folder.file("run-%d.zoo")).existing(), (Numbers{3, 12345}));
  EXPECT_THROW((void)NumberPattern("MESH", folder.file("no-%d.zoo")).existing(), InputError);
  EXPECT_THROW((void)NumberPattern("MESH", folder.file("none/%d.zoo")).existing(), InputError);
  EXPECT_THROW((void)NumberPattern("MESH", folder.file("%d/run.zoo")).existing(), UsageError);
}

TEST(NumberPattern, SaysWhyItFindsNoFile) {
  const test::ScratchFolder folder;
  const auto told = [&](const std::string& name) -> std::string {
    try {
      (void)NumberPattern("MESH", folder.file(name)).existing();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(told("no-%d.zoo"), folder.file("no-%d.zoo") + ": no file has a name of this pattern");
  EXPECT_EQ(told("none/%d.zoo"),
            folder.file("none/%d.zoo") + ": cannot be looked for (No such file or directory)");
  EXPECT_EQ(told("%d/run.zoo"), "MESH " + folder.file("%d/run.zoo") +
                                    ": the number is in a folder's name (one in the file's name "
                                    "expected)");
}

}  // namespace
}  // namespace hiac::tools
