// The steps of one file: what is left of its text when one of them has been chosen.
#include "formats/vtk/xml/xml_steps.hpp"

#include <fmt/format.h>

#include "tests/formats/files.hpp"

namespace hiac::formats::vtk {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

ReadOptions at_step(std::size_t step) {
  ReadOptions options;
  options.step = step;
  return options;
}

std::optional<XmlStep> step_of(const std::string& text, const ReadOptions& options = {}) {
  return xml_step(text, "Grid", options, "file");
}

/// What is said of a text; "none" where nothing is.
std::string step_refusal(const std::string& text, const ReadOptions& options = {}) {
  try {
    step_of(text, options);
  } catch (const InputError& error) {
    return error.what();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "none";
}

std::string grid_of(const std::string& attributes, const std::string& arrays) {
  return "<VTKFile><Grid" + attributes + ">" + arrays + "</Grid></VTKFile>";
}

std::string blanks(const std::string& text) { return std::string(text.size(), ' '); }

TEST(XmlSteps, ArraysOfOtherStepsAreBlanked) {
  const std::string times = " TimeValues=\"1 2.5\"";
  const std::string always = "<DataArray Name=\"a\">7</DataArray>";
  const std::string first = "<DataArray Name=\"b\" TimeStep=\"0\">8 <c/> 9</DataArray>";
  const std::string second = "<Array TimeStep='1' Name='b'/>";
  const std::string text = grid_of(times, always + first + second);
  const auto late = step_of(text);
  ASSERT_TRUE(late);
  EXPECT_THAT(late->times, ElementsAre(1, 2.5));
  EXPECT_EQ(late->step, 1U);
  EXPECT_EQ(late->text,
            grid_of(" " + blanks("TimeValues=\"1 2.5\""),
                    always + blanks(first) + "<Array " + blanks("TimeStep='1'") + " Name='b'/>"));
  const auto early = step_of(text, at_step(0));
  ASSERT_TRUE(early);
  EXPECT_EQ(early->step, 0U);
  EXPECT_EQ(early->text,
            grid_of(blanks(times), always + "<DataArray Name=\"b\" " + blanks("TimeStep=\"0\"") +
                                       ">8 <c/> 9</DataArray>" + blanks(second)));
  ASSERT_EQ(late->field_steps.size(), 1U);
  EXPECT_THAT(late->field_steps.at("b"), ElementsAre(0, 1));
}

TEST(XmlSteps, FilesWithoutStepsStayAsTheyAre) {
  EXPECT_FALSE(step_of(grid_of("", "<DataArray Name=\"a\">7</DataArray>")));
  EXPECT_FALSE(step_of("<Other><Grid TimeValues=\"1\"/></Other>"));
  EXPECT_FALSE(step_of("<VTKFile><Other TimeValues=\"1\"/></VTKFile>"));
  EXPECT_FALSE(step_of(""));
  EXPECT_FALSE(step_of("<VTKFile"));
  // marks that do not count up from zero are no steps
  EXPECT_FALSE(step_of(grid_of("", "<DataArray TimeStep=\"0\"/>")));
  EXPECT_FALSE(step_of(grid_of("", "<DataArray TimeStep=\"1\"/><DataArray TimeStep=\"2\"/>")));
  EXPECT_FALSE(step_of(grid_of("", "<Other TimeStep=\"0\"/><Other TimeStep=\"1\"/>")));
}

TEST(XmlSteps, StepsAreCountedWhereNoTimesAreTold) {
  const auto step = step_of(grid_of("", "<DataArray TimeStep=\"1 0\"/><Array TimeStep=\"2\"/>"));
  ASSERT_TRUE(step);
  EXPECT_THAT(step->times, ElementsAre(0, 1, 2));
  EXPECT_EQ(step->step, 2U);
  EXPECT_THAT(step->field_steps, IsEmpty());
  EXPECT_FALSE(step_of(
      grid_of("", "<DataArray TimeStep=\"0\"/><AppendedData/><DataArray TimeStep=\"1\"/>")));
}

TEST(XmlSteps, TextsThatOnlyLookLikeTags) {
  const std::string times = " a='TimeValues=\"9\"' b=\"/>\" TimeValues = '0 1' ";
  const std::string head = "<?xml version='>'?><!-- <Grid TimeValues=\"3\"> --><!DOCTYPE x>";
  const std::string arrays =
      "<!-- <DataArray TimeStep=\"5\"/> --><DataArray Name=\"'>\" TimeStep=\"0 1\"></DataArray>";
  const auto step = step_of(head + grid_of(times, arrays));
  ASSERT_TRUE(step);
  EXPECT_THAT(step->times, ElementsAre(0, 1));
  EXPECT_EQ(step->text,
            head + grid_of(" a='TimeValues=\"9\"' b=\"/>\" " + blanks("TimeValues = '0 1'") + " ",
                           "<!-- <DataArray TimeStep=\"5\"/> --><DataArray Name=\"'>\" " +
                               blanks("TimeStep=\"0 1\"") + "></DataArray>"));
}

TEST(XmlSteps, AppendedDataAreNotSearched) {
  const std::string behind = "<AppendedData encoding=\"raw\">_<DataArray TimeStep=\"9\"/>";
  const std::string text = grid_of(" TimeValues=\"4\"", "") + behind;
  const auto step = step_of(text);
  ASSERT_TRUE(step);
  EXPECT_EQ(step->text, grid_of(blanks(" TimeValues=\"4\""), "") + behind);
}

TEST(XmlSteps, WrongNumbersAreRefused) {
  const auto times = [](const std::string& values) {
    return step_refusal(grid_of(" TimeValues=\"" + values + "\"", ""));
  };
  EXPECT_EQ(times(" \n1\t2\r\n"), "none");
  EXPECT_EQ(times(""), "file: TimeValues tells no time");
  EXPECT_EQ(times("1 2,"), "file: TimeValues: numbers expected, '2,' found");
  EXPECT_EQ(times("x " + std::string(50, 'y')),
            "file: TimeValues: numbers expected, 'x " + std::string(38, 'y') + "' found");
  EXPECT_EQ(times("1 nan"), "file: TimeValues: a time is not finite (nan)");
  EXPECT_EQ(times("-inf"), "file: TimeValues: a time is not finite (-inf)");
  const auto marks = [](const std::string& arrays) {
    return step_refusal(grid_of(" TimeValues=\"1 2\"", arrays));
  };
  EXPECT_EQ(marks("<DataArray TimeStep=\"0\"/><DataArray TimeStep=\"1\"/>"), "none");
  EXPECT_EQ(marks("<DataArray TimeStep=\"2\"/>"),
            "file: an array belongs to step 2 (0 to 1 expected)");
  EXPECT_EQ(marks("<DataArray TimeStep=\"-1\"/>"), "file: TimeStep: numbers expected, '-1' found");
  EXPECT_EQ(marks("<DataArray TimeStep=\"1\"/>"),
            "file: tells 2 time steps, but no array belongs to step 0");
  EXPECT_EQ(marks("<DataArray TimeStep=\"0\"/>"),
            "file: tells 2 time steps, but no array belongs to step 1");
  EXPECT_EQ(marks("<DataArray TimeStep=\"0\"><DataArray TimeStep=\"1\"/>"),
            "file: is not well-formed: a DataArray is not closed");
}

TEST(XmlSteps, StepsAndTimesThatAreNotThere) {
  const std::string text = grid_of(" TimeValues=\"1 2.5\"", "");
  EXPECT_EQ(step_refusal(text, at_step(1)), "none");
  EXPECT_NE(step_refusal(text, at_step(2)), "none");
  ReadOptions options;
  options.time = 2.5;
  EXPECT_EQ(step_of(text, options)->step, 1U);
  options.time = 2;
  EXPECT_NE(step_refusal(text, options), "none");
}

}  // namespace
}  // namespace hiac::formats::vtk
