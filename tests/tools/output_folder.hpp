#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac::test {

/// An output of a tool: its command without it, the option that names it, and its extension.
struct Output {
  std::string command, option, extension;
  bool repeatable = true;  ///< the same run writes the same bytes
};

/// A folder with a mesh, a view and two pictures, in which the tools run.
class OutputFolder : public testing::Test {
 protected:
  static constexpr const char* kView =
      "[image]\nwidth = 8\nheight = 6\n[camera]\nprojection = \"orthographic\"\n"
      "eye = [0.5, 0.5, -3.0]\nlook_at = [0.5, 0.5, 0.0]\nup = [0.0, 1.0, 0.0]\nheight = 2.0\n"
      "[volume.extinction]\nfield = \"f\"\npoints = [[0.0, 1.0], [1.0, 1.0]]\n"
      "[volume.color]\nfield = \"f\"\npoints = [[0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 1.0, 0.0]]\n";

  void SetUp() override {
    ZooMesh mesh = random_delaunay(12, 1);
    add_node_field(mesh, "f", [](const Position& p) { return p[0]; });
    write_zoo_file(path("mesh.zoo"), {mesh, {}});
    std::ofstream(path("view.toml")) << kView;
    write_image(path("a.png"), Image(4, 3, rgba_channels(), std::vector<double>(48, 0.5)));
    write_image(path("b.png"), Image(4, 3, rgba_channels(), std::vector<double>(48, 0.25)));
  }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }

  /// The exit status of a shell command in the folder; complaint() is what it printed.
  [[nodiscard]] int run(const std::string& command) const {
    const std::string line = "cd '" + folder_.path().string() + "' && { " + command +
                             " ; } >stdout.txt 2>stderr.txt </dev/null";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] int run(const Output& output, const std::string& name) const {
    return run("timeout 60 " + output.command + " " + output.option + " " + name);
  }
  [[nodiscard]] std::string bytes_of(const std::string& name) const {
    return test::bytes_of(path(name));
  }
  [[nodiscard]] std::string complaint() const { return bytes_of("stderr.txt"); }

  /// The name to give for an output, and the file that is written for it.
  static std::string named(const Output& output) { return "out" + output.extension; }
  static std::string written(const Output& output) {
    return output.extension == ".f32" ? "out.r.f32" : named(output);
  }
  void remove_outputs() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      if (entry.path().filename().string().starts_with("out"))
        std::filesystem::remove_all(entry.path());
  }

  /// A device of no space; where none can be made, a link to the system's.
  void make_full_device(const std::string& name) const {
    if (mknod(path(name).c_str(), S_IFCHR | 0666, makedev(1, 7)) != 0)
      std::filesystem::create_symlink("/dev/full", path(name));
  }

 private:
  ScratchFolder folder_;
};

}  // namespace hiac::test
