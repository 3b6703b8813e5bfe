// The tools as a user chains them: by files and by pipes, on the project's own sample and, where
// the folder of real files is there, on the paper's Super Phoenix mesh.

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "hiac/geometry/cell_volume.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/scene/specification.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/reference.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac {
namespace {

class Pipeline : public test::ToolFolder {
 protected:
  // The same picture by pipes, by files, with one thread, and without a sort of its own.
  void expect_one_picture(const std::string& input, const std::string& view,
                          const std::string& size) const {
    const std::string draw = "$RENDER -q --size " + size + " --view '" + view + "' ";
    ASSERT_EQ(run("$CONVERT -q --corners-only '" + input + "' | $SORT -q --view '" + view + "' | " +
                  draw + "-o pipe.npy"),
              0)
        << bytes_of(file("err.txt"));
    ASSERT_EQ(run("$CONVERT -q --corners-only '" + input + "' -o m.zoo && $SORT m.zoo --view '" +
                  view + "' -o m.order && " + draw + "m.zoo --order m.order -o file.npy"),
              0)
        << bytes_of(file("err.txt"));
    ASSERT_EQ(run(draw + "--threads 1 m.zoo -o one.npy"), 0);
    const std::string picture = bytes_of(file("pipe.npy"));
    EXPECT_GT(picture.size(), 1000U);
    EXPECT_TRUE(picture == bytes_of(file("file.npy")));
    EXPECT_TRUE(picture == bytes_of(file("one.npy")));
  }
};

const std::string kSample = HIAC_SOURCE_DIR "/samples/reactor-pool/flow.vtu";
const std::string kSampleView = HIAC_SOURCE_DIR "/samples/reactor-pool/view.toml";

TEST_F(Pipeline, PipesAndFilesAndThreadsGiveOnePicture) {
  expect_one_picture(kSample, kSampleView, "400x300");
}

TEST_F(Pipeline, AFailedFirstStageLeavesNoPicture) {
  EXPECT_EQ(run("$CONVERT nothing.vtu | $SORT --view '" + kSampleView + "' | $RENDER --view '" +
                kSampleView + "' -o no.png"),
            3);
  EXPECT_FALSE(std::filesystem::exists(file("no.png")));
  EXPECT_NE(bytes_of(file("err.txt")).find("hiac-render: stdin: stream ended before"),
            std::string::npos)
      << bytes_of(file("err.txt"));
}

TEST_F(Pipeline, AnOrderOfAnotherViewOrMeshIsRefused) {
  ASSERT_EQ(run("$CONVERT -q --corners-only '" + kSample + "' -o m.zoo && $SORT m.zoo --view '" +
                kSampleView + "' -o m.order"),
            0);
  EXPECT_EQ(run("$RENDER m.zoo --order m.order --view '" + kSampleView +
                "' --set 'camera.eye=[1,2,3]' -o no.png"),
            3);
  EXPECT_NE(bytes_of(file("err.txt")).find("another view"), std::string::npos);
  EXPECT_EQ(run("$RENDER m.zoo --view '" + kSampleView + "' --set camera.fov=200 -o no.png"), 2);
  EXPECT_NE(bytes_of(file("err.txt")).find("--set camera.fov=200: key `camera.fov`: an angle"),
            std::string::npos);
  ASSERT_EQ(run("$CONVERT -q '" + kSample + "' -o p.zoo"), 0);
  EXPECT_EQ(run("$RENDER p.zoo --order m.order --view '" + kSampleView + "' -o no.png"), 3);
  EXPECT_FALSE(std::filesystem::exists(file("no.png")));
}

TEST_F(Pipeline, HalvesAccumulateToTheWhole) {
  ASSERT_EQ(run("$CONVERT -q --corners-only '" + kSample + "' -o m.zoo"), 0);
  const std::string render =
      "$RENDER -q m.zoo --view '" + kSampleView + "' --size 160x120 --set render.tolerance=1e-15 ";
  const std::string front = "--set 'camera.clip=[0,5.4]' ", back = "--set 'camera.clip=[5.4,100]' ";
  ASSERT_EQ(run(render + "-o whole.npy && " + render + front + "--no-background -o front.npy && " +
                render + back + "-o back.npy && " + render + front +
                "--under back.npy -o accumulated.npy"),
            0)
      << bytes_of(file("err.txt"));
  const Image whole = read_image(file("whole.npy")).image;
  const Image accumulated = read_image(file("accumulated.npy")).image;
  std::size_t through_both = 0;
  const Image in_front = read_image(file("front.npy")).image;
  const Image behind = read_image(file("back.npy")).image;
  for (std::size_t y = 0; y < 120; ++y)
    for (std::size_t x = 0; x < 160; ++x) {
      through_both += in_front.at(x, y, 3) > 0 && behind.at(x, y, 3) > 0 ? 1 : 0;
      for (std::size_t c = 0; c < 4; ++c)
        ASSERT_NEAR(accumulated.at(x, y, c), whole.at(x, y, c), 1e-12) << x << " " << y << " " << c;
    }
  EXPECT_GT(through_both, 1000U);

  EXPECT_EQ(run("$RENDER -q m.zoo --view '" + kSampleView + "' --under whole.npy -o no.png"), 3);
  EXPECT_NE(bytes_of(file("err.txt")).find("whole.npy: a picture of another size"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file("no.png")));

  Image broken = behind;
  broken.at(7, 5, 1) = std::numeric_limits<double>::quiet_NaN();
  write_image(file("broken.npy"), broken);
  EXPECT_EQ(run(render + "--under broken.npy -o no.png"), 3);
  EXPECT_NE(
      bytes_of(file("err.txt")).find("hiac-render: broken.npy: pixel 7,5: channel G is not finite"),
      std::string::npos)
      << bytes_of(file("err.txt"));
  EXPECT_FALSE(std::filesystem::exists(file("no.png")));
}

TEST_F(Pipeline, AColourBarIsDrawnBesideThePicture) {
  ASSERT_EQ(run("$CONVERT -q --corners-only '" + kSample + "' | $RENDER --view '" + kSampleView +
                "' --size 40x30 --depth 16 -o p.tiff --colorbar bar.png --json facts.json"),
            0)
      << bytes_of(file("err.txt"));
  EXPECT_EQ(read_image(file("p.tiff")).image.width(), 40U);
  EXPECT_GT(read_image(file("bar.png")).image.width(), 400U);
  // a tenth of the diagonal, 2.58, rounded down
  EXPECT_NE(bytes_of(file("facts.json")).find("\"color_bar_length\": 0.2,"), std::string::npos);
  EXPECT_EQ(run("$RENDER m.zoo --view '" + kSampleView + "' -o p.png --colorbar bar.jpg"), 2);
  EXPECT_EQ(run("$RENDER m.zoo --view '" + kSampleView + "' -o p.exr --depth 16"), 2);
}

TEST_F(Pipeline, WhatIsNotDrawnIsRefusedByName) {
  ASSERT_EQ(run("$CONVERT -q --corners-only '" + kSample + "' -o m.zoo"), 0);
  EXPECT_EQ(run("$RENDER m.zoo --view '" + kSampleView +
                "' --set render.interpolation=polynomial --channels error -o no.exr"),
            2);
  EXPECT_FALSE(std::filesystem::exists(file("no.exr")));
}

TEST_F(Pipeline, CellsInsideOutInPartAreNamedOrLeftOut) {
  // two bricks side by side, a corner of the second pushed through its opposite faces
  ZooMesh mesh = test::make_mesh({{0, 0, 0},
                                  {1, 0, 0},
                                  {2, 0, 0},
                                  {0, 1, 0},
                                  {1, 1, 0},
                                  {2, 1, 0},
                                  {0, 0, 1},
                                  {1, 0, 1},
                                  {2, 0, 1},
                                  {0, 1, 1},
                                  {1, 1, 1},
                                  {0.9, -0.1, -0.1}},
                                 {{CellKind::brick8, {0, 1, 4, 3, 6, 7, 10, 9}},
                                  {CellKind::brick8, {1, 2, 5, 4, 7, 8, 11, 10}}});
  test::add_node_field(mesh, "velocity", [](const test::Position&) { return 0.5; });
  write_zoo_file(file("m.zoo"), {mesh, {}});
  const std::string draw = "$RENDER m.zoo --view '" + kSampleView +
                           "' --size 40x30 --set volume.color.field=velocity "
                           "--set volume.extinction.field=velocity --json facts.json -o p.npy ";
  EXPECT_EQ(run(draw), 3);
  EXPECT_NE(
      bytes_of(file("err.txt")).find("cell 1 (brick8): the cell is turned inside out in part"),
      std::string::npos)
      << bytes_of(file("err.txt"));
  EXPECT_NE(
      bytes_of(file("err.txt"))
          .find("--skip-invalid leaves such cells out, and hiac-convert --invalid cut divides "
                "them into tetrahedra"),
      std::string::npos);
  EXPECT_EQ(run(draw + "--skip-invalid"), 0) << bytes_of(file("err.txt"));
  EXPECT_NE(bytes_of(file("err.txt")).find("1 of 2 cells"), std::string::npos);
  EXPECT_NE(bytes_of(file("facts.json")).find("\"skipped_cells\": 1"), std::string::npos);
  // the converter refuses it, too, leaves the cell out, or divides it
  EXPECT_EQ(run("$CONVERT m.zoo --invalid refuse -o r.zoo"), 3);
  EXPECT_NE(bytes_of(file("err.txt")).find("--invalid cut divides them into tetrahedra"),
            std::string::npos)
      << bytes_of(file("err.txt"));
  EXPECT_FALSE(std::filesystem::exists(file("r.zoo")));
  EXPECT_EQ(run("$CONVERT m.zoo --invalid skip -o s.zoo"), 0);
  EXPECT_EQ(read_zoo_file(file("s.zoo")).mesh.cell_count(), 1U);
  EXPECT_EQ(run("$CONVERT m.zoo --invalid cut -o c.zoo"), 0);
  EXPECT_NE(bytes_of(file("err.txt")).find("1 of them are so tangled"), std::string::npos);
  std::vector<double> xyz(mesh.xyz.begin(), mesh.xyz.end());
  std::copy_n(std::array{1.4, 0.4, 0.4}.begin(), 3, xyz.end() - 3);
  mesh.xyz = std::move(xyz);
  write_zoo_file(file("m.zoo"), {mesh, {}});
  EXPECT_EQ(run("$CONVERT m.zoo --invalid cut -o c.zoo --json cut.json"), 0);
  EXPECT_NE(bytes_of(file("err.txt")).find("changes the volume by"), std::string::npos)
      << bytes_of(file("err.txt"));
  const auto cut = nlohmann::json::parse(bytes_of(file("cut.json"))).at("invalid_cells");
  const double change = cut.at("volume_change").get<double>();
  EXPECT_GT(change, 0.01);
  EXPECT_NEAR(cut.at("relative_volume_change").get<double>(),
              change / (std::abs(signed_volume(mesh, 0)) + std::abs(signed_volume(mesh, 1))),
              1e-12);
  EXPECT_GT(read_zoo_file(file("c.zoo")).mesh.cell_count(), 2U);
  EXPECT_EQ(run("$RENDER c.zoo --view '" + kSampleView +
                "' --size 40x30 --set volume.color.field=velocity "
                "--set volume.extinction.field=velocity -o c.npy"),
            0)
      << bytes_of(file("err.txt"));
  EXPECT_EQ(run("$CONVERT m.zoo --invalid maybe -o c.zoo"), 2);
}

// A picture of the sample, small, by hiac-render with these options.
class SmallPicture : public Pipeline {
 protected:
  void SetUp() override {
    Pipeline::SetUp();
    ASSERT_EQ(run("$CONVERT -q --corners-only '" + kSample +
                  "' -o m.zoo && $SORT -q m.zoo --view '" + kSampleView + "' -o m.order"),
              0);
  }

  [[nodiscard]] int draw(const std::string& options) const {
    return run("$RENDER --order m.order --view '" + kSampleView + "' " + options + " m.zoo");
  }

  [[nodiscard]] Image picture(const std::string& options) const {
    EXPECT_EQ(draw(options + " -o picture.npy"), 0) << bytes_of(file("err.txt"));
    return read_image(file("picture.npy")).image;
  }
};

void expect_part_of(const Image& whole, const Image& part, std::size_t left, std::size_t top) {
  for (std::size_t y = 0; y < part.height(); ++y)
    for (std::size_t x = 0; x < part.width(); ++x)
      for (std::size_t c = 0; c < 4; ++c)
        ASSERT_EQ(part.at(x, y, c), whole.at(left + x, top + y, c)) << x << ' ' << y;
}

TEST_F(SmallPicture, ACropIsAPartOfIt) {
  for (const std::string options :
       {"--size 160x120", "--size 160x120 --samples 3 --filter bspline"}) {
    const Image whole = picture(options), part = picture(options + " --crop 50,27,41,22");
    EXPECT_EQ(part.width(), 41U);
    EXPECT_EQ(part.height(), 22U);
    expect_part_of(whole, part, 50, 27);
    EXPECT_GT(part.at(20, 10, 3), 0);
  }
}

TEST_F(SmallPicture, SamplesAreAveraged) {
  const Image larger = picture("--size 120x90 --no-background");
  for (const char* filter : {"", " --filter box"}) {
    const Image mean = picture("--size 60x45 --no-background --samples 2" + std::string(filter));
    for (std::size_t y = 0; y < 45; ++y)
      for (std::size_t x = 0; x < 60; ++x)
        for (std::size_t c = 0; c < 4; ++c)
          ASSERT_EQ(mean.at(x, y, c),
                    ((larger.at(2 * x, 2 * y, c) + larger.at(2 * x + 1, 2 * y, c)) +
                     (larger.at(2 * x, 2 * y + 1, c) + larger.at(2 * x + 1, 2 * y + 1, c))) /
                        4);
  }
}

TEST_F(SmallPicture, SplattedCellsAreCounted) {
  ASSERT_EQ(draw("--size 60x45 --set render.splat_below=2 --json facts.json -o splatted.npy"), 0);
  EXPECT_NE(bytes_of(file("err.txt")).find("cells splatted"), std::string::npos);
  const std::string facts = bytes_of(file("facts.json"));
  EXPECT_NE(facts.find("\"splatted_cells\": "), std::string::npos);
  EXPECT_EQ(facts.find("\"splatted_cells\": 0"), std::string::npos) << facts;
}

TEST_F(SmallPicture, WhatIsNotInThePictureIsAUsageError) {
  for (const char* options :
       {"--crop 1150,0,51,10", "--crop 0,0,0,10", "--crop 1,2,3", "--crop 1,2,3,",
        "--crop '1, 2,3,4'", "--crop 1,2,3,99999999999", "--crop 1,2,3,4,5", "--crop 1,2,3,-4",
        "--crop a,2,3,4", "--samples 0", "--samples 100", "--samples -1", "--filter bspline",
        "--samples 2 --filter tent"}) {
    EXPECT_EQ(draw(std::string(options) + " -o no.png"), 2) << options;
    EXPECT_FALSE(std::filesystem::exists(file("no.png")));
    const std::string said = bytes_of(file("err.txt"));
    EXPECT_EQ(said.rfind("hiac-render: ", 0), 0U) << said;
    EXPECT_EQ(said.find('\n'), said.size() - 1) << said;
  }
}

TEST_F(Pipeline, ChannelsAreWrittenWhereTheyFit) {
  ASSERT_EQ(run("$CONVERT -q --corners-only '" + kSample + "' -o m.zoo"), 0);
  const std::string render = "$RENDER -q m.zoo --size 40x30 --view '" + kSampleView + "' ";
  ASSERT_EQ(run(render + "--channels depth,error -o more.exr"), 0) << bytes_of(file("err.txt"));
  const Image image = read_image(file("more.exr")).image;
  EXPECT_EQ(image.channel_count(), 6U);
  EXPECT_TRUE(image.channel_index("depth") && image.channel_index("error"));
  EXPECT_EQ(run(render + "--channels depth -o no.png"), 2);
  EXPECT_EQ(run(render + "--channels depht -o no.npy"), 2);
  EXPECT_NE(bytes_of(file("err.txt")).find("--channels: no channel is called 'depht'"),
            std::string::npos);
  EXPECT_EQ(run(render + "--channels error --set render.integration=gauss5 -o no.npy"), 2);
  EXPECT_FALSE(std::filesystem::exists(file("no.npy")));
}

// The picture of a foreign file, by every way through the tools, beside brute force's pixels.
class BruteForce : public Pipeline {
 protected:
  void expect_its_picture(const std::string& input, const std::string& eye) const {
    std::ofstream(file("view.toml")) << R"([image]
width = 320
height = 240
[camera]
projection = "perspective"
eye = )" << eye << R"(
look_at = [0.0, 0.0, 0.0]
up = [0.0, 0.0, 1.0]
fov = 30.0
[volume.color]
field = "scalars"
points = [[0.0, 0.1, 0.2, 0.9], [0.8, 0.2, 0.9, 0.3], [0.8, 0.9, 0.9, 0.3], [2.3, 0.9, 0.1, 0.1]]
[volume.extinction]
field = "scalars"
points = [[0.0, 0.1], [0.5, 0.3], [0.9, 4.0], [1.2, 0.2], [2.3, 2.0]]
[render]
tolerance = 1e-14
)";
    expect_one_picture(input, file("view.toml"), "320x240");
    const ZooMesh mesh = read_zoo_file(file("m.zoo")).mesh;
    const Scene scene = read_scene(file("view.toml")).scene;
    const Image image = read_image(file("pipe.npy")).image;
    double largest = 0;
    std::size_t covered = 0;
    for (std::uint32_t y = 4; y < scene.image.height; y += 9)
      for (std::uint32_t x = 4; x < scene.image.width; x += 9) {
        const auto expected = test::reference_pixel(mesh, scene, x, y);
        covered += expected[3] > 0 ? 1 : 0;
        for (std::size_t c = 0; c < 4; ++c)
          largest = std::max(largest, std::abs(expected[c] - image.at(x, y, c)));
      }
    EXPECT_GT(covered, 100U);
    EXPECT_LE(largest, 1e-12);
  }
};

TEST_F(BruteForce, DrawsTetrahedraOfRandomPoints) {
  ZooMesh mesh = test::random_delaunay(150, 5);
  test::add_node_field(mesh, "scalars", [](const test::Position& p) {
    return 1.1 + p[0] * p[1] - 0.7 * std::sin(4 * p[2]);
  });
  std::ofstream out(file("cells.vtk"));
  out.precision(17);
  out << "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
      << mesh.node_count() << " double\n";
  for (const double x : mesh.xyz) out << x << "\n";
  out << "CELLS " << mesh.cell_count() << " " << 5 * mesh.cell_count() << "\n";
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    out << 4;
    for (const NodeId node : mesh.cell_nodes(cell)) out << " " << node;
    out << "\n";
  }
  out << "CELL_TYPES " << mesh.cell_count() << "\n";
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) out << "10\n";
  out << "POINT_DATA " << mesh.node_count() << "\nSCALARS scalars double\nLOOKUP_TABLE default\n";
  for (const double value : mesh.fields[0].values) out << value << "\n";
  out.close();
  expect_its_picture(file("cells.vtk"), "[2.1, -2.9, 1.7]");
}

TEST_F(BruteForce, DrawsSuperPhoenix) {
  const char* named = std::getenv("HIAC_DATA_DIR");
  const std::string data = named != nullptr ? named : HIAC_DEFAULT_DATA_DIR;
  const std::string spx = data + "/vtk_legacy/classic/spx.vtk";
  if (!std::filesystem::exists(spx)) GTEST_SKIP() << "no " << spx;
  expect_its_picture(spx, "[11.452, -15.616, 9.37]");
}

}  // namespace
}  // namespace hiac
