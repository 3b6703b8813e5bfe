#include "hiac/preview/context.hpp"

#include <algorithm>
#include <cctype>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/preview/gl_objects.hpp"
#include "tests/preview/preview_support.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;

class PreviewContext : public test::WithDriver {};

TEST_F(PreviewContext, IsOneOfTheDevicesByNumberOrName) {
  const std::string name = context().device().name;
  EXPECT_GE(context().limits().picture_side, 1024U);
  const auto devices = preview::list_devices();
  ASSERT_FALSE(devices.empty());
  std::string part = devices.back().name.substr(0, 6);
  std::ranges::transform(part, part.begin(), [](unsigned char c) { return std::toupper(c); });
  EXPECT_EQ(preview::Context(std::to_string(devices.size() - 1)).device().platform,
            devices.back().platform);
  EXPECT_EQ(preview::Context(part).device().name.substr(0, 6), devices.back().name.substr(0, 6));
}

TEST_F(PreviewContext, RefusesADeviceThatIsNotThere) {
  try {
    const preview::Context other("no such device");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("there is no such device"));
    EXPECT_THAT(error.what(), HasSubstr("found no such device"));
  }
  EXPECT_THROW(preview::Context("4711"), UsageError);
}

TEST_F(PreviewContext, AFaultOfACallIsAnError) {
  context().check("doing nothing");
  glEnable(GL_COLOR_ATTACHMENT0);  // no capability
  EXPECT_THROW(context().check("asking for nonsense"), preview::DriverError);
  context().check("doing nothing");
}

// By default a driver that loses a context goes on as if nothing had happened.
TEST_F(PreviewContext, AsksTheDriverToTellOfALoss) {
  if (!epoxy_has_gl_extension("GL_KHR_robustness") && !epoxy_has_gl_extension("GL_ARB_robustness"))
    GTEST_SKIP() << context().device().name << " cannot tell";
  GLint strategy = 0;
  glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
  EXPECT_EQ(strategy, GL_LOSE_CONTEXT_ON_RESET);
}

TEST_F(PreviewContext, ALostContextIsAnError) {
  const auto status = glGetGraphicsResetStatus;
  glGetGraphicsResetStatus = [] { return GLenum{GL_INNOCENT_CONTEXT_RESET}; };
  EXPECT_THROW(context().check("drawing"), preview::DriverError);
  glGetGraphicsResetStatus = status;
  context().check("drawing");
}

TEST_F(PreviewContext, AShaderThatIsRefusedIsAnErrorOfOneLine) {
  try {
    preview::compute_program("#version 450 core\nvoid main() { nonsense; }\n");
    FAIL();
  } catch (const preview::DriverError& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::internal);
    EXPECT_THAT(error.what(), HasSubstr("nonsense"));
    EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
  }
}

}  // namespace
}  // namespace hiac
