// MED files written through HDF5, so that they can hold what MED-fichier does not write: what is
// said of it, and groups, profiles and steps whose result is known.
#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/hdf5_output.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using MedIntegers = std::vector<std::int64_t>;
using MedReals = std::vector<double>;

const std::string kMedMesh = "/ENS_MAA/mesh";
const std::string kMedStep = kMedMesh + "/s1";
const std::string kMedWhole = "MED_NO_PROFILE_INTERNAL";

/// What a file has; what a test does not set is that of a tetrahedron without fields.
struct MedFile {
  std::int64_t version = 3;
  std::int64_t type = 0;
  std::int64_t axes = 0;
  std::int64_t dimensions = 3;
  std::string units = {};
  MedReals coordinates{0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  std::string element = "TE4";
  MedIntegers nodes{1, 3, 2, 4};
};

/// Writes it; `more` adds to it.
template <typename More>
void write_med(const std::string& path, const MedFile& med, const More& more) {
  Hdf5Output file(path);
  file.group("/INFOS_GENERALES");
  file.attribute("/INFOS_GENERALES", "MAJ", MedIntegers{med.version});
  file.group("/ENS_MAA");
  file.group(kMedMesh);
  file.attribute(kMedMesh, "TYP", MedIntegers{med.type});
  file.attribute(kMedMesh, "REP", MedIntegers{med.axes});
  file.attribute(kMedMesh, "ESP", MedIntegers{med.dimensions});
  if (!med.units.empty()) file.attribute(kMedMesh, "UNI", med.units);
  if (!med.coordinates.empty()) file.put(kMedStep + "/NOE/COO", med.coordinates);
  if (!med.nodes.empty()) file.put(kMedStep + "/MAI/" + med.element + "/NOD", med.nodes);
  more(file);
}

std::string med_refusal(const MedFile& med) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.med");
  write_med(path, med, [](Hdf5Output&) {});
  const std::string message = refusal(path);
  return message.empty() ? message : message.substr(path.size() + 2);
}

template <typename More>
std::string med_refusal_with(const More& more, const MedFile& med = {}) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.med");
  write_med(path, med, more);
  const std::string message = refusal(path);
  return message.empty() ? message : message.substr(path.size() + 2);
}

template <typename More>
Reading med_reading(const More& more, const MedFile& med = {}, const ReadOptions& options = {}) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.med");
  write_med(path, med, more);
  return read_any(path, options);
}

TEST(MedRefusals, FilesWithoutAMeshThatIsRead) {
  EXPECT_EQ(med_refusal({}), "");
  EXPECT_EQ(med_refusal({.version = 2}),
            "/INFOS_GENERALES: MED version 2 (3 or later expected; medimport makes it so)");
  EXPECT_EQ(med_refusal({.version = 4}), "");
  EXPECT_EQ(med_refusal({.type = 1}),
            "/ENS_MAA/mesh: is a structured mesh (an unstructured one expected)");
  EXPECT_EQ(med_refusal({.axes = 1}),
            "/ENS_MAA/mesh: has cylindrical or spherical coordinates (Cartesian ones expected)");
  EXPECT_EQ(med_refusal({.coordinates = {}}), "/ENS_MAA/mesh: has no points");
  const ScratchFolder folder;
  const std::string path = folder.file("a.med");
  {
    Hdf5Output file(path);
    file.group("/INFOS_GENERALES");
  }
  EXPECT_EQ(refusal(path), path + ": /ENS_MAA: is not there (a mesh expected)");
  {
    Hdf5Output file(path);
    file.group("/ENS_MAA");
  }
  EXPECT_EQ(refusal(path), path + ": /ENS_MAA: holds no mesh");
}

TEST(MedRefusals, CoordinatesAndNodesInWholeNumbers) {
  EXPECT_EQ(med_refusal({.dimensions = 0}),
            "/ENS_MAA/mesh/s1/NOE/COO: 12 coordinates do not fit 0 dimensions");
  EXPECT_EQ(med_refusal({.dimensions = 4}),
            "/ENS_MAA/mesh/s1/NOE/COO: 12 coordinates do not fit 4 dimensions");
  EXPECT_EQ(med_refusal({.coordinates = {0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0}}),
            "/ENS_MAA/mesh/s1/NOE/COO: 11 coordinates do not fit 3 dimensions");
  EXPECT_EQ(med_refusal({.nodes = {1, 3, 2, 4, 1}}),
            "/ENS_MAA/mesh/s1/MAI/TE4/NOD: 5 nodes make no whole number of cells of 4");
  EXPECT_THAT(med_refusal({.dimensions = 2,
                           .coordinates = {0, 1, 0, 0, 0, 1},
                           .element = "TR3",
                           .nodes = {1, 2, 3}}),
              HasSubstr("no volume cells"));
  EXPECT_THAT(med_refusal({.nodes = {}}), HasSubstr("no volume cells"));
  EXPECT_THAT(med_refusal({.nodes = {0, 3, 2, 4}}), HasSubstr("cell TE4 1: there is no node 0"));
  EXPECT_THAT(med_refusal({.nodes = {5, 3, 2, 4}}), HasSubstr("cell TE4 1: there is no node 5"));
}

TEST(MedRefusals, TypesThatAreNotKnown) {
  EXPECT_THAT(med_refusal({.element = "XX9", .nodes = {1, 2}}), HasSubstr("1 XX9"));
  const auto with_index = [](const std::string& name, const MedIntegers& index) {
    return [=](Hdf5Output& file) { file.put(kMedStep + "/MAI/" + name + "/IND", index); };
  };
  EXPECT_THAT(med_refusal_with(with_index("XX9", {1, 5, 9, 12})), HasSubstr("3 XX9"));
  EXPECT_THAT(med_refusal_with(with_index("XX9", {1})), HasSubstr("1 XX9"));
  // polygons have no volume
  const Reading reading = med_reading(with_index("POG", {1, 5, 9}));
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, Contains("dropped cells without volume: 2 POG"));
}

TEST(MedRefusals, FacesOfPolyhedraThatDoNotFit) {
  const MedIntegers nodes{1, 2, 3, 1, 4, 2, 2, 4, 3, 3, 4, 1};
  const auto polyhedra = [&](const MedIntegers& faces_at, const MedIntegers& nodes_at) {
    return med_refusal_with([&](Hdf5Output& file) {
      file.put(kMedStep + "/MAI/POE/IFN", faces_at);
      file.put(kMedStep + "/MAI/POE/INN", nodes_at);
      file.put(kMedStep + "/MAI/POE/NOD", nodes);
    });
  };
  const std::string group = "/ENS_MAA/mesh/s1/MAI/POE: does not fit itself (entries ";
  EXPECT_EQ(polyhedra({1, 5}, {1, 4, 7, 10, 13}), "");
  EXPECT_EQ(polyhedra({0, 5}, {1, 4, 7, 10, 13}), group + "0 to 5 of 5)");
  EXPECT_EQ(polyhedra({1, 6}, {1, 4, 7, 10, 13}), group + "1 to 6 of 5)");
  EXPECT_EQ(polyhedra({3, 2}, {1, 4, 7, 10, 13}), group + "3 to 2 of 5)");
  EXPECT_EQ(polyhedra({1, 5}, {1, 4, 7, 10, 14}), group + "10 to 14 of 13)");
  EXPECT_EQ(polyhedra({1, 5}, {0, 4, 7, 10, 13}), group + "0 to 4 of 13)");
  EXPECT_EQ(polyhedra({1, 5}, {1, 4, 3, 10, 13}), group + "4 to 3 of 13)");
  EXPECT_EQ(polyhedra({1}, {1}), "");
  // a face without nodes fits the lists
  EXPECT_THAT(polyhedra({1, 6}, {1, 4, 7, 10, 13, 13}), testing::Not(HasSubstr("fit itself")));
}

/// A field's group with its number of components.
std::string med_field(Hdf5Output& file, const std::string& name, std::int64_t components = 1) {
  const std::string group = "/CHA/" + name;
  if (name == "f") file.group("/CHA");
  file.group(group);
  file.attribute(group, "NCO", MedIntegers{components});
  return group;
}

TEST(MedRefusals, FieldsThatDoNotFit) {
  const auto components = [](std::int64_t count) {
    return med_refusal_with([=](Hdf5Output& file) { med_field(file, "f", count); });
  };
  EXPECT_EQ(components(0), "/CHA/f: has 0 components (1 to 1000 expected)");
  EXPECT_EQ(components(1), "");
  EXPECT_EQ(components(1000), "");
  EXPECT_EQ(components(1001), "/CHA/f: has 1001 components (1 to 1000 expected)");
  const auto values = [](std::size_t count, const std::string& support) {
    return med_refusal_with([&](Hdf5Output& file) {
      const std::string group = med_field(file, "f", 2);
      file.put(group + "/t/" + support + "/" + kMedWhole + "/CO", MedReals(count, 1));
    });
  };
  EXPECT_EQ(values(8, "NOE"), "");
  EXPECT_EQ(values(7, "NOE"),
            "/CHA/f/t/NOE/MED_NO_PROFILE_INTERNAL/CO: holds 7 values (8 expected)");
  EXPECT_EQ(values(2, "MAI.TE4"), "");
  EXPECT_EQ(values(3, "MAI.TE4"),
            "/CHA/f/t/MAI.TE4/MED_NO_PROFILE_INTERNAL/CO: holds 3 values (2 expected)");
  EXPECT_EQ(values(8, "NOE.TE4"), "");
  EXPECT_EQ(values(9, "NOE.TE4"),
            "/CHA/f/t/NOE.TE4/MED_NO_PROFILE_INTERNAL/CO: holds 9 values (8 expected)");
}

TEST(MedRefusals, CornersOfEveryCell) {
  // two tetrahedra in one place
  const MedFile two{.nodes = {1, 1, 3, 3, 2, 2, 4, 4}};
  const ZooMesh mesh =
      med_reading(
          [](Hdf5Output& file) {
            file.put(med_field(file, "f", 2) + "/t/NOE.TE4/" + kMedWhole + "/CO",
                     MedReals{1, 2, 3, 4, 5, 6, 7, 8, 11, 12, 13, 14, 15, 16, 17, 18});
          },
          two)
          .mesh;
  const Field& field = field_named(mesh, "f");
  EXPECT_EQ(field.location, FieldLocation::corner);
  // MED counts the second node of a cell where the mesh has its third
  EXPECT_THAT(field.values.view(),
              ElementsAre(1, 11, 3, 13, 2, 12, 4, 14, 5, 15, 7, 17, 6, 16, 8, 18));
}

TEST(MedRefusals, ProfilesNameItemsThatThereAre) {
  const auto profile = [](const MedIntegers& items) {
    return [=](Hdf5Output& file) {
      file.put("/PROFILS/some/PFL", items);
      const std::string group = med_field(file, "f");
      MedReals values;
      for (const std::int64_t item : items) values.push_back(10.0 * static_cast<double>(item));
      file.put(group + "/t/NOE/some/CO", values);
    };
  };
  EXPECT_EQ(med_refusal_with(profile({0})), "/PROFILS/some/PFL: names item 0 (1 to 4 expected)");
  EXPECT_EQ(med_refusal_with(profile({2, 5})), "/PROFILS/some/PFL: names item 5 (1 to 4 expected)");
  const ZooMesh mesh = med_reading(profile({4, 1})).mesh;
  for (NodeId node = 0; node < 4; ++node) {
    const auto x = mesh.position(node);
    const double value = field_named(mesh, "f").values[node];
    if (x[2] == 1)
      EXPECT_EQ(value, 40);
    else if (x[0] == 0 && x[1] == 0)
      EXPECT_EQ(value, 10);
    else
      EXPECT_TRUE(std::isnan(value));
  }
}

/// A family and its groups, whose names stand in rows of 80 characters.
void put_family(Hdf5Output& file, const std::string& name, std::int64_t number,
                const std::vector<std::string>& groups) {
  const std::string family = "/FAS/mesh/ELEME/" + name;
  std::vector<std::uint8_t> rows;
  for (const std::string& group : groups) {
    rows.insert(rows.end(), group.begin(), group.end());
    rows.resize(rows.size() + 80 - group.size());
  }
  file.put(family + "/GRO/NOM", rows, {groups.size(), 80});
  file.attribute(family, "NUM", MedIntegers{number});
}

TEST(MedRefusals, GroupsAreRunsOfCells) {
  // four tetrahedra in one place: their families tell them apart
  const MedFile four{.nodes = {1, 1, 1, 1, 3, 3, 3, 3, 2, 2, 2, 2, 4, 4, 4, 4}};
  const auto families = [](const MedIntegers& numbers) {
    return [=](Hdf5Output& file) {
      put_family(file, "a", -1, {"left", "all"});
      put_family(file, "b", -2, {"all"});
      // a family of no group
      file.group("/FAS/mesh/ELEME/c");
      file.attribute("/FAS/mesh/ELEME/c", "NUM", MedIntegers{0});
      file.put(kMedStep + "/MAI/TE4/FAM", numbers);
      file.put(med_field(file, "f") + "/t/MAI.TE4/" + kMedWhole + "/CO", MedReals{5, 6, 7, 8});
    };
  };
  const auto cells = [&](const MedIntegers& numbers, const std::string& block) {
    ReadOptions options;
    options.block = block;
    const ZooMesh mesh = med_reading(families(numbers), four, options).mesh;
    const auto values = field_named(mesh, "f").values.view();
    return MedReals(values.begin(), values.end());
  };
  EXPECT_THAT(cells({-1, -2, 0, -1}, "left"), ElementsAre(5, 8));
  EXPECT_THAT(cells({-1, -2, 0, -1}, "all"), ElementsAre(5, 6, 8));
  EXPECT_THAT(cells({-2, -1, -1, 0}, "left"), ElementsAre(6, 7));
  EXPECT_THAT(cells({-2, -1, -1, 0}, "all"), ElementsAre(5, 6, 7));
  EXPECT_EQ(med_refusal_with(families({-1, -2, 0}), four),
            "/ENS_MAA/mesh/s1/MAI/TE4/FAM: holds 3 numbers (4 expected)");
}

TEST(MedRefusals, UnitsThatAllComponentsHave) {
  const auto unit = [](const std::string& units) -> std::string {
    const ZooMesh mesh = med_reading([](Hdf5Output&) {}, {.units = units}).mesh;
    for (const auto& [key, text] : mesh.metadata)
      if (key == "length unit") return text;
    return "none";
  };
  const auto wide = [](const std::string& text) { return fmt::format("{:16}", text); };
  EXPECT_EQ(unit(wide("mm") + wide("mm") + wide("mm")), "mm");
  EXPECT_EQ(unit(wide("mm") + wide("mm") + wide("m")), "none");
  EXPECT_EQ(unit(wide("mm") + wide("m") + wide("mm")), "none");
  EXPECT_EQ(unit(wide("mm") + wide("mm")), "none");
  EXPECT_EQ(unit(""), "none");
  EXPECT_EQ(unit("sixteen letters!sixteen letters!sixteen letters!"), "sixteen letters!");
}

TEST(MedRefusals, LaterStepsMoveThePoints) {
  const auto later = [](Hdf5Output& file) {
    file.attribute(kMedStep, "NDT", MedIntegers{2});
    file.attribute(kMedStep, "NOR", MedIntegers{-1});
    // by its name it comes first, by its number last
    file.put(kMedMesh + "/s0/NOE/COO", MedReals{0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2});
    file.attribute(kMedMesh + "/s0", "NDT", MedIntegers{3});
    file.attribute(kMedMesh + "/s0", "NOR", MedIntegers{-1});
  };
  const Reading reading = med_reading(later);
  EXPECT_THAT(reading.notes, Contains("the mesh has 2 steps of its own: took the last"));
  double largest = 0;
  for (const double x : reading.mesh.xyz) largest = std::max(largest, x);
  EXPECT_EQ(largest, 2);
}

TEST(MedRefusals, OneOfSeveralMeshesIsRead) {
  const Reading reading = med_reading([](Hdf5Output& file) {
    file.put("/ENS_MAA/other/s1/NOE/COO", MedReals{0, 0, 0});
    file.put("/ENS_MAA/third/s1/NOE/COO", MedReals{0, 0, 0});
    const std::string mine = med_field(file, "f");
    file.attribute(mine, "MAI", std::string("mesh"));
    file.put(mine + "/t/NOE/" + kMedWhole + "/CO", MedReals{1, 2, 3, 4});
    const std::string others = med_field(file, "g");
    file.attribute(others, "MAI", std::string("other"));
    file.put(others + "/t/NOE/" + kMedWhole + "/CO", MedReals{1});
  });
  EXPECT_THAT(reading.notes,
              Contains("read the mesh 'mesh' alone; the file has 2 more: other, third"));
  ASSERT_EQ(reading.mesh.fields.size(), 1U);
  EXPECT_EQ(reading.mesh.fields[0].name, "f");
}

TEST(MedRefusals, WhatIsLeftOutIsTold) {
  const Reading reading = med_reading([](Hdf5Output& file) {
    const std::string group = med_field(file, "f", 1);
    file.put(group + "/t/MAI.TE4/" + kMedWhole + "/CO", MedReals{1, 2, 3, 4, 5});
    file.attribute(group + "/t/MAI.TE4/" + kMedWhole, "NGA", MedIntegers{5});
    file.put(group + "/t/ARE.SE2/" + kMedWhole + "/CO", MedReals{1});
    const std::string single = med_field(file, "g", 1);
    file.put(single + "/t/MAI.TE4/" + kMedWhole + "/CO", MedReals{9});
    file.attribute(single + "/t/MAI.TE4/" + kMedWhole, "NGA", MedIntegers{1});
  });
  EXPECT_THAT(reading.notes, Contains("left out field 'f' at ARE.SE2, integration points"));
  ASSERT_EQ(reading.mesh.fields.size(), 1U);
  EXPECT_EQ(field_named(reading.mesh, "g").values[0], 9);
}

TEST(MedRefusals, StepsInTheOrderOfTheirNumbers) {
  const auto steps = [](Hdf5Output& file) {
    const std::string group = med_field(file, "f", 2);
    for (const auto& [name, number, order, time] :
         {std::tuple<std::string, int, int, double>{"a", 2, 1, 0.25},
          {"b", 1, 2, 0.5},
          {"c", 1, 1, 0.75}}) {
      const std::string step = group + "/" + name;
      const double value = 100 * time;
      file.put(step + "/NOE/" + kMedWhole + "/CO", MedReals{value, 1, 2, 3, value + 1, 4, 5, 6});
      file.attribute(step, "NDT", MedIntegers{number});
      file.attribute(step, "NOR", MedIntegers{order});
      file.attribute(step, "PDT", MedReals{time});
    }
  };
  const ScratchFolder folder;
  const std::string path = folder.file("a.med");
  write_med(path, {}, steps);
  EXPECT_THAT(format_to_read(path).inspect(path).times, ElementsAre(0.75, 0.5, 0.25));
  ReadOptions options;
  options.step = 1;
  const ZooMesh mesh = read_any(path, options).mesh;
  // the values of a component stand together
  for (NodeId node = 0; node < 4; ++node) {
    const auto x = mesh.position(node);
    if (x[0] == 0 && x[1] == 0 && x[2] == 0) {
      EXPECT_EQ(field_named(mesh, "f").values[2 * node], 50);
      EXPECT_EQ(field_named(mesh, "f").values[2 * node + 1], 51);
    } else if (x[2] == 1) {
      EXPECT_EQ(field_named(mesh, "f").values[2 * node], 3);
      EXPECT_EQ(field_named(mesh, "f").values[2 * node + 1], 6);
    }
  }
}

// What a file does not tell: version, kind of mesh, axes and dimension are those of most files.
TEST(MedRefusals, AttributesMayBeMissing) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.med");
  {
    const MedFile med;
    Hdf5Output file(path);
    file.put(kMedStep + "/NOE/COO", med.coordinates);
    file.put(kMedStep + "/MAI/TE4/NOD", med.nodes);
    file.put("/CHA/f/t/NOE/" + kMedWhole + "/CO", MedReals{5, 6, 7, 8});
    file.attribute("/CHA/f", "NCO", MedIntegers{1});
  }
  const Reading reading = read_any(path);
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, testing::IsEmpty());
  EXPECT_EQ(field_named(reading.mesh, "f").values.size(), 4U);
  EXPECT_EQ(field_named(reading.mesh, "f").unit, "");
  EXPECT_THAT(format_to_read(path).inspect(path).times, testing::IsEmpty());
}

}  // namespace
}  // namespace hiac::formats
