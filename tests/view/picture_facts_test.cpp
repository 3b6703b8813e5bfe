// The words of the status line.

#include "tools/view/window/picture_facts.hpp"

#include <gtest/gtest.h>

namespace hiac::view {
namespace {

Painted facts_picture() {
  Painted picture;
  picture.size = {40, 30};
  picture.pixels = 1200;
  picture.seconds = 0.125;
  return picture;
}

std::string facts(const Painted& picture,
                  const std::optional<std::optional<double>>& error = std::nullopt,
                  double scale = 1) {
  return picture_facts(picture, error, scale).toStdString();
}

TEST(PictureFacts, TellOfAnExactPicture) {
  Painted picture = facts_picture();
  const std::string head = "accurate engine \u00b7 exact: 1200 pixels";
  const std::string tail = " \u00b7 0.125 s \u00b7 order verified: 0 segments out of order";
  EXPECT_EQ(facts(picture), head + tail);
  EXPECT_EQ(facts(picture, 2.34e-12), head + " \u00b7 error at most 2.3e-12" + tail);
  EXPECT_EQ(facts(picture, std::optional<double>()),
            head + " \u00b7 no error bound claimed" + tail);
  picture.samples = 3;
  EXPECT_EQ(facts(picture), head + ", 9 rays each" + tail);
  picture.samples = 1;
  picture.mean_optical_depth = 1.2345;
  EXPECT_EQ(facts(picture), head + tail + " \u00b7 mean optical depth 1.23");
  EXPECT_EQ(facts(picture, std::nullopt, 0.5),
            head + tail + " \u00b7 mean optical depth 1.23 \u00b7 shown at 50 %");
  picture.violations = 7;
  picture.mean_optical_depth = 0;
  EXPECT_EQ(facts(picture), head + " \u00b7 0.125 s \u00b7 7 segments out of order");
}

TEST(PictureFacts, TellHowManyPixelsOfACoarsePictureThereAre) {
  Painted picture = facts_picture();
  picture.step = 3;
  picture.pixels = 140;
  EXPECT_EQ(facts(picture, 1e-12),  // of the whole picture, which this is not
            "accurate engine \u00b7 140 of 1200 pixels \u00b7 0.125 s \u00b7 order verified: 0 "
            "segments out of order");
}

TEST(PictureFacts, NameTheDeviceOfAPreview) {
  Painted picture = facts_picture();
  picture.device = "a card";
  auto wanted = std::make_shared<Wanted>();
  picture.wanted = wanted;
  EXPECT_EQ(facts(picture), "hardware preview, single precision, by a card \u00b7 0.125 s");
  wanted->scene.edges.emplace();
  EXPECT_EQ(facts(picture),
            "hardware preview, single precision, without edges, by a card \u00b7 0.125 s");
}

}  // namespace
}  // namespace hiac::view
