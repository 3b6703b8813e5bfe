#include "formats/registry.hpp"

#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tests/formats/complaints.hpp"

namespace hiac::formats {
namespace {

using testing::HasSubstr;

TEST(Registry, ContentDecidesBeforeTheName) {
  const ScratchFolder folder;
  const std::string legacy = folder.write("a.dat", "# vtk DataFile Version 3.0\n");
  EXPECT_EQ(format_to_read(legacy).name, "vtk");
  const std::string xml =
      folder.write("b.vtk",
                   "<?xml version='1.0'?>\n<!-- c -->\n<VTKFile header_type=\"UInt64\" "
                   "type=\"ImageData\">");
  EXPECT_EQ(format_to_read(xml).name, "vti");
}

TEST(Registry, UnknownContentIsRefused) {
  const ScratchFolder folder;
  const auto message = [](const std::string& path) {
    try {
      format_to_read(path);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(folder.write("a.vtu", "no XML")), HasSubstr("is not a vtu file"));
  EXPECT_THAT(message(folder.write("a.unheard", "nothing")), HasSubstr("unknown file format"));
  EXPECT_THAT(message(folder.write("empty.vtk", "")), HasSubstr("is empty"));
  EXPECT_THAT(message(folder.file("missing.vtk")), HasSubstr("cannot be opened"));
  EXPECT_THAT(message("/"), HasSubstr("is a directory"));
}

TEST(Registry, RefusalsTellWhatTheNameSays) {
  const std::string what =
      " file, although its name says so (neither this nor any other known format found in its "
      "first bytes)";
  expect_complaints("a.vtu",
                    {{"", ": is empty (a mesh expected)"}, {"x", ": is not a vtu" + what}});
  expect_complaints("a.NEU",
                    {{"", ": is empty (a mesh expected)"}, {"\n", ": is not a gambit" + what}});
  expect_complaints("a.stl", {{"x",
                               ": is the file of a surface (a mesh of cells with a volume "
                               "expected)"}});
  // b"nothing" by gzip
  const std::string packed(
      "\x1f\x8b\x08\0\0\0\0\0\2\3\xcb\xcb\x2f\xc9\xc8\xcc\x4b\7\0\xd7"
      "\x8e\x29\x22\7\0\0\0",
      27);
  for (const std::string name : {"a.vtu", "a.vtu.gz", "a.neu.gz", "a.gz"})
    expect_complaints(name,
                      {{packed, ": is packed by gzip, and what it holds is of no known format"}});
}

TEST(Registry, RefusalsOfUnknownNamesListTheFormats) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.unheard", "x");
  const std::string message = refusal(path);
  EXPECT_THAT(message, testing::StartsWith(path + ": unknown file format (one of zoo, "));
  EXPECT_THAT(message, testing::EndsWith(" expected)"));
  EXPECT_THAT(message, HasSubstr(", vtu, "));
  EXPECT_THAT(message, testing::Not(HasSubstr("stl")));
  try {
    format_to_write("a.vts");
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(),
                testing::StartsWith("a.vts: no format with the extension '.vts' can be written "
                                    "(expected one of zoo, "));
    EXPECT_THAT(error.what(), testing::Not(HasSubstr("gambit")));
  }
  try {
    format_named("vtuu");
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("format vtuu: there is no such format (expected "
                                                  "one of zoo, "));
    EXPECT_THAT(error.what(), HasSubstr(", stl"));
  }
}

/// What the list of the formats says of one, and how it is read and written: r read, w written,
/// z packed by gzip too, c told by a container's contents, p by the name and plausible first bytes,
/// b a surface.
struct Listed {
  std::string name, extensions, kinds, fields, time_steps, abilities;
};

const std::vector<Listed> kListed{
    {"zoo", ".zoo", "all fifteen", "node, cell, corner", "one", "rw"},
    {"zparts", ".zparts", "all fifteen", "node, cell, corner", "one", "rw"},
    {"vtk", ".vtk", "tet4-20 pyr5,13 prism6,15 wedge7 brick8,20", "node, cell", "one", "r"},
    {"vtu", ".vtu", "tet4-20 pyr5,13 prism6,15 wedge7 brick8,20", "node, cell", "several", "rw"},
    {"pvtu", ".pvtu", "tet4-20 pyr5,13 prism6,15 wedge7 brick8,20", "node, cell", "several", "r"},
    {"vts", ".vts", "brick8", "node, cell", "several", "r"},
    {"vti", ".vti", "brick8", "node, cell", "several", "r"},
    {"vtr", ".vtr", "brick8", "node, cell", "several", "r"},
    {"pvts", ".pvts", "brick8", "node, cell", "several", "r"},
    {"pvti", ".pvti", "brick8", "node, cell", "several", "r"},
    {"pvtr", ".pvtr", "brick8", "node, cell", "several", "r"},
    {"pvd", ".pvd", "those of the files that it names", "node, cell", "several", "r"},
    {"vtm", ".vtm .vtmb .vtpc .vtpd", "those of the files that it names", "node, cell", "one", "r"},
    {"gmsh", ".msh", "tet4-20 pyr5-21 prism6-24 wedge7,18 brick8-32", "node, cell, corner", "many",
     "rwz"},
    {"abaqus", ".inp", "tet4,10 pyr5 prism6,15 wedge7,18 brick8,20", "none", "none", "rzp"},
    {"frd", ".frd", "tet4,10 prism6,15 brick8,20", "node", "many", "rzp"},
    {"nastran", ".bdf .nas .fem .dat .blk .bulk", "tet4,10 pyr5,13 prism6,15 wedge7,18 brick8,20",
     "none", "none", "rzp"},
    {"ansys", ".cdb", "tet4,10 pyr5,13 prism6,15 wedge7,18 brick8,20", "none", "none", "rz"},
    {"unv", ".unv", "tet4,10 prism6,15 wedge7 brick8,20", "node, cell, corner", "many", "rz"},
    {"ucd", ".inp .ucd .avs", "tet4 pyr5 prism6 wedge7 brick8", "node, cell", "none", "rzp"},
    {"medit", ".mesh .meshb", "tet4,10 pyr5 prism6 wedge7 brick8", "node, cell (references)",
     "none", "rz"},
    {"ugrid", ".ugrid", "tet4 pyr5 prism6 wedge7 brick8", "none", "none", "rzp"},
    {"su2", ".su2", "tet4 pyr5 prism6 wedge7 brick8", "none", "none", "rz"},
    {"tetgen", ".node .ele", "tet4,10", "node, cell (attributes)", "none", "rp"},
    {"netgen", ".vol", "tet4,10 pyr5,13 prism6,15 wedge7,18 brick8,20", "cell (index)", "none",
     "rz"},
    {"gambit", ".neu", "tet4,10 pyr5 prism6,15 wedge7,18 brick8,20", "node, cell (marks)", "none",
     "rzp"},
    {"tecplot", ".dat .tec .plt .tp", "tet4 pyr5 prism6 wedge7 brick8, polyhedra, ordered",
     "node, cell", "many", "rz"},
    {"vtkhdf", ".vtkhdf .hdf", "tet4-20 pyr5,13 prism6,15 wedge7 brick8,20", "node, cell",
     "several", "rwc"},
    {"xdmf", ".xdmf .xmf", "tet4,10 pyr5,13 prism6,15 brick8,20", "node, cell", "several", "r"},
    {"med", ".med .rmed .mmed", "tet4,10 pyr5,13 prism6,15 brick8,20", "node, cell, corner",
     "several", "rc"},
    {"exodus", ".e .exo .ex2 .exii .exo2 .gen .g", "tet4,10 pyr5,13 prism6,15 brick8,20, polyhedra",
     "node, cell", "several", "rc"},
    {"cgns", ".cgns", "tet4,10,20 pyr5,13,21 prism6,15,24 brick8,20,32", "node, cell", "several",
     "rc"},
    {"silo", ".silo .root", "tet4 pyr5 prism6 brick8, polyhedra, structured", "node, cell", "one",
     "rc"},
    {"d3plot", ".d3plot", "tet4,10 pyr5 prism6 brick8", "node, cell", "many", "r"},
    {"ensight", ".case .encas", "tet4,10 pyr5,13 prism6,15 brick8,20", "node, cell", "several",
     "r"},
    {"plot3d", ".xyz .x .g .grd .p3d .bin .p3dfmt", "brick8 and its degenerate ones", "node",
     "several (.p3d)", "rp"},
    {"mfem", ".mesh", "tet4-20 pyr5 prism6 brick8", "node, cell", "one", "r"},
    {"openfoam", ".foam .openfoam", "tet4 pyr5 prism6 wedge7 brick8", "node, cell", "several",
     "rc"},
    {"stl", ".stl", "boundary triangles", "none", "one", "wb"},
    {"ply", ".ply", "boundary triangles", "node, cell", "one", "wb"},
    {"vtp", ".vtp", "boundary triangles", "node, cell", "one", "wb"}};

std::string abilities_of(const Format& format) {
  std::string found;
  if (format.read) found += 'r';
  if (format.write) found += 'w';
  if (format.gzip) found += 'z';
  if (format.contains) found += 'c';
  if (format.plausible) found += 'p';
  if (format.write_boundary) found += 'b';
  EXPECT_EQ(bool(format.read), bool(format.inspect)) << format.name;
  return found;
}

// as docs/formats.md has them; formats that need a library may be missing
TEST(Registry, ListsWhatEveryFormatHolds) {
  const std::set<std::string> optional{"vtkhdf", "xdmf", "med", "exodus", "cgns", "silo"};
  std::size_t place = 0;
  for (const Listed& listed : kListed) {
    SCOPED_TRACE(listed.name);
    ASSERT_LT(place, all_formats().size());
    const Format& format = all_formats()[place];
    if (format.name != listed.name && optional.contains(listed.name)) continue;
    ++place;
    EXPECT_EQ(format.name, listed.name);
    EXPECT_EQ(fmt::format("{}", fmt::join(format.extensions, " ")), listed.extensions);
    EXPECT_EQ(format.kinds, listed.kinds);
    EXPECT_EQ(format.fields, listed.fields);
    EXPECT_EQ(format.time_steps, listed.time_steps);
    EXPECT_EQ(abilities_of(format), listed.abilities);
  }
  EXPECT_EQ(place, all_formats().size());
}

TEST(Registry, NamesAreChecked) {
  EXPECT_EQ(format_named("vtu").name, "vtu");
  EXPECT_THROW(format_named("vtuu"), UsageError);
  EXPECT_EQ(format_to_write("x.VTU").name, "vtu");
  EXPECT_THROW(format_to_write("x.vts"), UsageError);
  EXPECT_THROW(format_to_write("x"), UsageError);
}

}  // namespace
}  // namespace hiac::formats
