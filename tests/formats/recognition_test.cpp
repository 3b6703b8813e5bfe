// By what beginnings the formats know their files, and what is none of them.
#include "tests/formats/files.hpp"
#include "tests/formats/raw_bytes.hpp"

namespace hiac::formats {
namespace {

struct Beginning {
  std::string head;
  bool known;
};

void expect_recognized(const std::string& format, const std::vector<Beginning>& rows) {
  const Format& known = format_named(format);
  for (const auto& [head, expected] : rows)
    EXPECT_EQ(known.recognizes(head), expected) << format << ":\n" << head;
}

/// What the format takes for its own where the name says so, too.
void expect_plausible(const std::string& format, const std::vector<Beginning>& rows) {
  const Format& known = format_named(format);
  ASSERT_TRUE(known.plausible) << format;
  for (const auto& [head, expected] : rows)
    EXPECT_EQ(known.plausible(head), expected) << format << ":\n" << head;
}

TEST(Recognition, DecksOfAbaqusBeginWithAKeyword) {
  expect_recognized("abaqus", {{"*NODE\n", true},
                               {"** c\n\n  *Heading\n", true},
                               {"*node, nset=a", true},
                               {"*KEYWORD\n", false},
                               {"*keyword_x\n", false},
                               {"*\n", false},
                               {"*1\n", false},
                               {"** c\n", false},
                               {"x\n*NODE\n", false},
                               {"", false}});
  expect_plausible("abaqus", {{"** c\n", true}, {"* c\n", false}, {"\n** c\n", false}});
}

TEST(Recognition, DecksOfNastranHoldBulkData) {
  expect_recognized("nastran", {{"BEGIN BULK\n", true},
                                {"sol 101\nbegin super=1 bulk\n", true},
                                {"BEGIN\n", false},
                                {"CEND\n", true},
                                {"cend \n", true},
                                {"CENDX\n", false},
                                {"x\nGRID    1\n", true},
                                {"GRID,1\n", true},
                                {"grid*   1\n", true},
                                {"GRID\n", false},
                                {"GRIDS,1\n", false},
                                {" BEGIN BULK\n", false}});
  expect_plausible("nastran", {{"$ c\n", true},
                               {"\n\n$ c\n", true},
                               {"SOL 101\n", true},
                               {"SOL=101\n", true},
                               {"sol,101\n", true},
                               {"SOLVE\n", false},
                               {"ID a,b\n", true},
                               {"IDENTITY\n", false},
                               {"INCLUDE 'a'\n", true},
                               {"TITLE = x\n", true},
                               {"SUBTITLE=x\n", true},
                               {"NASTRAN BUFFSIZE\n", true},
                               {"ASSIGN(a)\n", true},
                               {"INIT\n", true},
                               {"TIME 5\n", true},
                               {"DIAG 8\n", true},
                               {"ECHO\n", true},
                               {"x\nSOL 101\n", false}});
}

TEST(Recognition, DecksOfAnsysHoldACommandOfTheirs) {
  expect_recognized("ansys", {{"/PREP7\n", true},
                              {"x\n/prep7\n", true},
                              {"/COM,ANSYS RELEASE\n", true},
                              {"/COM,others\n", false},
                              {"nblock,3\n", true},
                              {"/batch\n", true},
                              {"ET,1,185\n", true},
                              {"ETX\n", false},
                              {" /PREP7\n", false}});
}

TEST(Recognition, FilesOfGmshBeginWithASection) {
  expect_recognized("gmsh", {{"$MeshFormat\n2.2 0 8\n", true},
                             {"$NOD\n", true},
                             {"$Comments\n", true},
                             {"\n# c\n// d\n $MeshFormat \n", true},
                             {"$Mesh\n", false},
                             {"x\n$MeshFormat\n", false},
                             {"", false}});
}

TEST(Recognition, UniversalFilesBeginWithAMark) {
  expect_recognized("unv", {{"    -1\n  2411\n", true},
                            {"\n  \n    -1\n   151\n", true},
                            {"    -1\nx\n", false},
                            {"   -1\n  2411\n", false},
                            {"    -12\n  2411\n", false},
                            {"x\n    -1\n  2411\n", false},
                            {"", false}});
}

TEST(Recognition, FilesOfMeshersBeginWithTheirTitles) {
  expect_recognized("netgen", {{"mesh3d\n", true},
                               {"# c\n\n mesh3d \n", true},
                               {"mesh3d x\n", false},
                               {"x\nmesh3d\n", false},
                               {"", false}});
  expect_recognized("gambit", {{"        CONTROL INFO 2\n** GAMBIT NEUTRAL FILE\n", true},
                               {"        CONTROL INFO 2\n", false},
                               {std::string(79, ' ') + "CONTROL INFO\nGAMBIT NEUTRAL", true},
                               {std::string(80, ' ') + "CONTROL INFO\nGAMBIT NEUTRAL", false}});
  expect_plausible("gambit", {{std::string(79, ' ') + "CONTROL INFO", true},
                              {std::string(80, ' ') + "CONTROL INFO", false}});
  expect_recognized("medit", {{"MeshVersionFormatted 2\n", true},
                              {"# c\n\nMeshVersionFormatted\n2\n", true},
                              {"MeshVersion\n", false},
                              {"x MeshVersionFormatted\n", false}});
  const auto gmf = [](std::int32_t one, std::int32_t version, std::int32_t code) {
    return raw_bytes<std::int32_t>({one, version, code});
  };
  expect_recognized("medit", {{gmf(1, 1, 3), true},
                              {gmf(1, 4, 3), true},
                              {gmf(0x01000000, 0x02000000, 0x03000000), true},
                              {gmf(1, 0, 3), false},
                              {gmf(1, 5, 3), false},
                              {gmf(1, 2, 4), false},
                              {gmf(2, 2, 3), false},
                              {gmf(1, 2, 3).substr(0, 11), false}});
  expect_recognized("mfem", {{"MFEM mesh v1.0\n", true},
                             {"MFEM NURBS mesh v1.0\n", true},
                             {"MFEM\n mesh v1.0\n", false},
                             {"x MFEM mesh v1.0\n", false}});
}

TEST(Recognition, UcdFilesBeginWithFiveCounts) {
  expect_plausible("ucd", {{"4 1 0 0 0\n", true},
                           {"# c\n\n 4 1 0 0 0 \n", true},
                           {"\7", true},
                           {"4 1 0 0\n", false},
                           {"4 1 0 0 0 0\n", false},
                           {"4 1 0 0 x\n", false},
                           {"\6", false}});
  expect_recognized("ucd", {{"4 1 0 0 0\n", false}});
}

TEST(Recognition, FilesOfTecplotBeginWithARecord) {
  expect_recognized("tecplot", {{"VARIABLES = X\n", true},
                                {"variables\n", true},
                                {"# c\n\nZONE T=x\n", true},
                                {"ZONE", true},
                                {"ZONES\n", false},
                                {"VARIABLES2 = x\n", true},
                                {"FILETYPE=FULL\n", true},
                                {"TITLE = x\nVARIABLES = X\n", true},
                                {"TITLE = x\nrest of it\nZONE\n", true},
                                {"TITLE = x\n", false},
                                {"x\nZONE\n", false},
                                {"#!TDV112", true},
                                {"#!TDW112", false}});
}

TEST(Recognition, CasesOfEnSightTellTheirFormat) {
  expect_recognized("ensight", {{"FORMAT\ntype: ensight gold\n", true},
                                {"# c\nGEOMETRY\nmodel: x\nFORMAT\n\n type:  ensight\n", true},
                                {"type: ensight\nFORMAT\n", false},
                                {"FORMAT\ntype: other\n", false},
                                {"FORMAT\n", false},
                                {"FORMATS\ntype: ensight\n", false}});
}

TEST(Recognition, HeadersOfOpenFoamStandBehindAnything) {
  expect_recognized("openfoam", {{"/* c */\nFoamFile\n{", true},
                                 {"FoamFile{", true},
                                 {"FoamFile x {", false},
                                 {"this is a FoamFile\n", false},
                                 {"FoamFile", false},
                                 {"FoamFile x", false},
                                 {"Foam {", false}});
}

TEST(Recognition, OfPlot3dIndicesAlone) {
  expect_recognized("plot3d", {{"{\"filenames\": []}", true}, {"2 2 2\n", false}});
}

}  // namespace
}  // namespace hiac::formats
