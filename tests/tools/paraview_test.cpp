// States and cameras of ParaView as --view, and the macro that saves them.

#include <fstream>

#include <gmock/gmock.h>

#include "tests/tools/tool_folder.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class ParaviewInput : public ToolFolder {
 protected:
  ParaviewInput() {
    const std::filesystem::path states(HIAC_PARAVIEW_STATES);
    for (const char* name : {"block.vtu", "rgb.pvsm", "surfaces.pvsm", "views.pvsm"})
      std::filesystem::copy_file(states / name, file(name));
    std::ofstream(file("a.pvcc")) << camera();
  }

  static std::string vector_property(const std::string& name, const char* x, const char* y,
                                     const char* z) {
    std::string text = "<Property name=\"" + name + "\">";
    for (const char* value : {x, y, z}) text += std::string("<Element value=\"") + value + "\"/>";
    return text + "</Property>";
  }
  static std::string camera() {
    return "<PVCameraConfiguration version=\"1.0\"><Proxy>" +
           vector_property("CameraPosition", "4", "-9", "5") +
           vector_property("CameraFocalPoint", "0.5", "0", "0") +
           vector_property("CameraViewUp", "0", "0", "1") +
           "<Property name=\"CameraParallelProjection\"><Element value=\"1\"/></Property>"
           "<Property name=\"CameraParallelScale\"><Element value=\"3.25\"/></Property>"
           "</Proxy></PVCameraConfiguration>";
  }
};

TEST_F(ParaviewInput, IsAView) {
  ASSERT_EQ(run("$RENDER block.vtu --view rgb.pvsm -o a.npy"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("extinction: opacity / "));
  // the same picture in two more ways: of the data that the state names, and through a pipe
  ASSERT_EQ(run("$RENDER --view rgb.pvsm -o b.npy </dev/null"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("mesh: block.vtu, which the state names"));
  ASSERT_EQ(run("$CONVERT block.vtu | $SORT --view rgb.pvsm | $RENDER --view rgb.pvsm -o c.npy"), 0)
      << complaint();
  EXPECT_EQ(bytes_of(file("a.npy")), bytes_of(file("b.npy")));
  EXPECT_EQ(bytes_of(file("a.npy")), bytes_of(file("c.npy")));
  ASSERT_EQ(run("$RENDER block.vtu --view rgb.pvsm --set camera.fov=50 -o d.npy"), 0);
  EXPECT_NE(bytes_of(file("a.npy")), bytes_of(file("d.npy")));
}

TEST_F(ParaviewInput, MayBeACameraOfAStarterView) {
  ASSERT_EQ(run("$RENDER block.vtu --view a.pvcc --field RTData@node --size 40x30 -o a.npy"), 0)
      << complaint();
  ASSERT_EQ(run("$RENDER block.vtu --field RTData@node --set camera.projection=orthographic "
                "--set camera.fov= --set camera.height=6.5 --set 'camera.eye=[4,-9,5]' "
                "--set 'camera.look_at=[0.5,0,0]' --set 'camera.up=[0,0,1]' --size 40x30 -o b.npy"),
            0)
      << complaint();
  EXPECT_EQ(bytes_of(file("a.npy")), bytes_of(file("b.npy")));
  EXPECT_EQ(run("$CONVERT block.vtu -o m.zoo && $SORT m.zoo --view a.pvcc -o m.order"), 0)
      << complaint();
}

TEST_F(ParaviewInput, SaysWhatIsNotAsInParaView) {
  ASSERT_EQ(run("$RENDER block.vtu --view surfaces.pvsm -o a.png"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("warning: surfaces.pvsm: not as in ParaView: Slice1 (Cut)"));
  EXPECT_EQ(run("$RENDER block.vtu --view surfaces.pvsm --strict -o strict.png"), 1);
  EXPECT_THAT(folder_.names(), Not(testing::Contains("strict.png")));
}

TEST_F(ParaviewInput, OfSeveralViewsIsOne) {
  ASSERT_EQ(run("$RENDER block.vtu --view 'views.pvsm#Second' -o a.png"), 0) << complaint();
  EXPECT_EQ(run("$RENDER block.vtu --view 'views.pvsm#Third' -o a.png"), 2);
  EXPECT_THAT(complaint(), HasSubstr("expected one of RenderView1, Second"));
}

TEST_F(ParaviewInput, IsRefusedWhereItIsDamaged) {
  EXPECT_EQ(run("head -c 20000 rgb.pvsm >half.pvsm; $RENDER block.vtu --view half.pvsm -o a.png"),
            3);
  EXPECT_THAT(complaint(), HasSubstr("half.pvsm: malformed XML"));
  EXPECT_EQ(run("$RENDER block.vtu --view none.pvsm -o a.png"), 3);
}

// Runs the macro's own function on a volume of a filter's output.
TEST_F(ParaviewInput, OfAFiltersOutputNeedsItsData) {
  ASSERT_EQ(run("sed 's/group=\"sources\" type=\"XMLUnstructuredGridReader\"/"
                "group=\"filters\" type=\"Threshold\"/' rgb.pvsm >filter.pvsm"),
            0);
  EXPECT_EQ(run("$RENDER block.vtu --view filter.pvsm -o a.png"), 3);
  EXPECT_THAT(complaint(), HasSubstr("(Threshold)"));
  ASSERT_EQ(run("cp block.vtu saved.vtu; python3 -c \"import sys, re; sys.path.append('" HIAC_MACRO
                "'); sys.dont_write_bytecode = True; import hiac_paraview; "
                "id = re.search('type=.Threshold. id=.([0-9]+)', open('filter.pvsm').read())[1]; "
                "hiac_paraview.read_saved_data('filter.pvsm', id, 'XMLUnstructuredGridReader', "
                "'saved.vtu')\""),
            0)
      << complaint();
  ASSERT_EQ(run("$RENDER --view filter.pvsm -o a.npy </dev/null"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("mesh: saved.vtu"));
  ASSERT_EQ(run("$RENDER block.vtu --view rgb.pvsm -o b.npy"), 0) << complaint();
  EXPECT_EQ(bytes_of(file("a.npy")), bytes_of(file("b.npy")));
}

}  // namespace
}  // namespace hiac::test
