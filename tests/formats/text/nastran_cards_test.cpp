// Entries of bulk data in fields of eight and sixteen columns and between commas, with
// continuations, comments and tabs (Quick Reference Guide, "Format of bulk data entries").
#include "formats/nastran/bulk_cards.hpp"
#include "formats/nastran/bulk_data.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using nastran::Card;
using nastran::CardReader;
using testing::ElementsAre;

/// The name of every entry, and its fields behind bars.
std::vector<std::string> cards_of(const std::string& text) {
  TextCursor cursor(text, "a.bdf");
  CardReader reader(cursor);
  std::vector<std::string> cards;
  while (const Card* card = reader.next()) {
    std::string all(card->name);
    for (const std::string_view field : card->fields) all += "|" + std::string(field);
    while (all.ends_with('|')) all.pop_back();
    cards.push_back(all);
  }
  return cards;
}

TEST(NastranCards, SmallFieldsHaveEightColumns) {
  EXPECT_THAT(
      cards_of("GRID    12345678       1     1.0-2.50000     3.0       7      12    last\n"),
      ElementsAre("GRID|12345678|1|1.0|-2.50000|3.0|7|12|last"));
  // the tenth field belongs to the continuation
  EXPECT_THAT(cards_of("GRID    1       2       3       4       5       6       7       8       "
                       "+A\n"),
              ElementsAre("GRID|1|2|3|4|5|6|7|8"));
  EXPECT_THAT(cards_of("CORD2R\n"), ElementsAre("CORD2R"));
  EXPECT_THAT(cards_of("GRID           9"), ElementsAre("GRID|9"));
}

TEST(NastranCards, LargeFieldsHaveSixteenColumns) {
  EXPECT_THAT(cards_of("GRID*                  1               21.00000000000000-2.0000000000000\n"
                       "*                    3.0\n"),
              ElementsAre("GRID|1|2|1.00000000000000|-2.0000000000000|3.0"));
  EXPECT_THAT(cards_of("GRID*,1,2,3,4\n*,5\n"), ElementsAre("GRID|1|2|3|4|5"));
  // a line between commas has four fields if its name has a star, and eight if not
  EXPECT_THAT(cards_of("GRID*,1,2,3,4,5\n"), ElementsAre("GRID|1|2|3|4"));
  EXPECT_THAT(cards_of("GRID,1,2,3,4,5,6,7,8,9\n"), ElementsAre("GRID|1|2|3|4|5|6|7|8"));
}

TEST(NastranCards, ContinuationsFillTheLineBefore) {
  EXPECT_THAT(cards_of("CHEXA,1,2\n,3,4\n+,5\n*,6\n        7       8\nGRID,1\n"),
              ElementsAre("CHEXA|1|2|||||||3|4|||||||5||||||||6||||7|8", "GRID|1"));
  EXPECT_THAT(cards_of("CHEXA,1\n$ c\n\n  $ d\n,2\n"), ElementsAre("CHEXA|1||||||||2"));
  // eight blanks alone are an empty line
  EXPECT_THAT(cards_of("GRID,1\n        \n         2\nGRID,3\n"),
              ElementsAre("GRID|1||||||||2", "GRID|3"));
}

TEST(NastranCards, CommentsTabsAndTheEnd) {
  EXPECT_THAT(cards_of("GRID,1,2 $ 3\n$GRID,4\nGRID,5$\n"), ElementsAre("GRID|1|2", "GRID|5"));
  EXPECT_THAT(cards_of("GRID\t1\t2\t\t3.5\n"), ElementsAre("GRID|1|2||3.5"));
  EXPECT_THAT(cards_of("GRID    1\t\t2\n"), ElementsAre("GRID|1||2"));
  EXPECT_THAT(cards_of("GRID,1\nENDDATA\nGRID,2\n"), ElementsAre("GRID|1"));
  EXPECT_THAT(cards_of("GRID,1\n enddata 5\nGRID,2\n"), ElementsAre("GRID|1"));
  EXPECT_THAT(cards_of("=,*1,=\n=(3)\n ==\n"), ElementsAre("=|*1|=", "=", "="));
  EXPECT_THAT(cards_of("PARAM=1\nINCLUDE 'a,b'\n").size(), 2U);
}

TEST(NastranCards, AComma10ColumnsInMakesNoFreeLine) {
  // the first field has eight columns; blanks may follow the name
  EXPECT_THAT(cards_of("GRID    ,1,2\n"), ElementsAre("GRID|1|2"));
  EXPECT_THAT(cards_of("GRID     ,1,2\n"), ElementsAre("GRID|1|2"));
  EXPECT_THAT(cards_of("GRID      ,1,2\n"), ElementsAre("GRID|,1,2"));
}

TEST(NastranSolids, FlatElementsAreNoVolumesAndUnknownOnesNoElements) {
  std::string deck;
  std::size_t count = 0;
  for (const char* name :
       {"CBAR",   "CBEAM",  "CBEAM3", "CBEND",  "CBUSH",  "CBUSH1D", "CBUSH2D", "CDAMP1", "CDAMP2",
        "CDAMP3", "CDAMP4", "CELAS1", "CELAS2", "CELAS3", "CELAS4",  "CFAST",   "CGAP",   "CONM1",
        "CONM2",  "CONROD", "CMASS1", "CMASS2", "CMASS3", "CMASS4",  "CQUAD",   "CQUAD4", "CQUAD8",
        "CQUADR", "CQUADX", "CROD",   "CSHEAR", "CTRIA3", "CTRIA6",  "CTRIAR",  "CTRIAX", "CTRIAX6",
        "CTUBE",  "CVISC",  "CWELD",  "PLOTEL", "RBE1",   "RBE2",    "RBE3",    "RBAR"})
    deck += std::string(name) + "," + std::to_string(++count) + ",1\n";
  const ScratchFolder folder;
  const ForeignMesh mesh =
      nastran::read_bulk_data(folder.write("a.bdf", deck + "CTRIA9,77\nPSOLID,1,1\nMAT1,1\n"));
  ASSERT_EQ(mesh.cell_count(), count);
  EXPECT_EQ(mesh.types.size(), count);
  for (std::size_t cell = 0; cell < count; ++cell) {
    EXPECT_EQ(mesh.types[mesh.cell_types[cell]].conversion.fate, CellFate::no_volume);
    EXPECT_EQ(mesh.cell_numbers[cell], static_cast<std::int64_t>(cell + 1));
  }
  // two that the zoo has no kind for
  const ForeignMesh rich = nastran::read_bulk_data(folder.write("b.bdf", "CIHEX2,5,1\nCIHEX3,6\n"));
  ASSERT_EQ(rich.cell_count(), 2U);
  EXPECT_EQ(rich.types[1].conversion.fate, CellFate::unsupported);
  EXPECT_EQ(rich.types[1].name, "CIHEX3");
  EXPECT_THAT(rich.cell_numbers, ElementsAre(5, 6));
}

}  // namespace
}  // namespace hiac::formats
