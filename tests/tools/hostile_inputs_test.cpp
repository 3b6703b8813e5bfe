// Inputs that are not plain files, that name others, or that hold more than they seem to.
#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <zlib.h>

#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class HostileInputs : public ToolFolder {
 protected:
  void SetUp() override {
    ToolFolder::SetUp();
    ZooMesh mesh = random_delaunay(12, 1);
    add_node_field(mesh, "f", [](const Position& p) { return p[0]; });
    write_zoo_file(file("m.zoo"), {mesh, {}});
  }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(file(name)).parent_path());
    std::ofstream(file(name), std::ios::binary) << text;
  }
  /// A VTU file of `blocks` packed megabytes of points that are all zero, with one cell.
  void write_zeros(const std::string& name, std::size_t blocks) const {
    constexpr std::size_t kPoints = 87'381;
    const std::string zeros(12 * kPoints, '\0');
    uLongf size = compressBound(zeros.size());
    std::string block(size, '\0');
    ASSERT_EQ(compress2(reinterpret_cast<Bytef*>(block.data()), &size,
                        reinterpret_cast<const Bytef*>(zeros.data()), zeros.size(), 9),
              Z_OK);
    block.resize(size);
    std::vector<std::uint64_t> header{blocks, zeros.size(), zeros.size()};
    header.insert(header.end(), blocks, block.size());
    std::string text =
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid>"
        "<Piece NumberOfPoints=\"" +
        std::to_string(kPoints * blocks) +
        "\" NumberOfCells=\"1\"><Points><DataArray type=\"Float32\" Name=\"Points\" "
        "NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/></Points><Cells>"
        "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>"
        "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray>"
        "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray></Cells></Piece>"
        "</UnstructuredGrid><AppendedData encoding=\"raw\">_";
    text.append(reinterpret_cast<const char*>(header.data()), 8 * header.size());
    for (std::size_t b = 0; b < blocks; ++b) text += block;
    write(name, text + "</AppendedData></VTKFile>\n");
  }
  /// One line, and the report that --json asked for.
  void expect_end_at_the_limit(const std::string& input) const {
    EXPECT_THAT(complaint(),
                AllOf(HasSubstr(input + ": takes more than"), HasSubstr("--max-memory SIZE")));
    EXPECT_EQ(std::ranges::count(complaint(), '\n'), 1) << complaint();
    EXPECT_THAT(bytes_of(file("facts.json")),
                AllOf(HasSubstr("\"error\": \"" + input + ": takes more than"),
                      HasSubstr("\"exit_code\": 3"), HasSubstr("\"total\"")));
  }
  /// What a converted mesh is, apart from the name that it came from.
  [[nodiscard]] std::string hash(const std::string& name) const {
    return content_hash(read_zoo_file(file(name)).mesh);
  }
};

TEST_F(HostileInputs, PackedDataEndAtTheLimitOfMemory) {
  const std::string deck =
      "*NODE\\n1,0,0,0\\n2,1,0,0\\n3,0,1,0\\n4,0,0,1\\n*ELEMENT,TYPE=C3D4\\n1,1,2,3,4\\n";
  ASSERT_EQ(
      run("(printf '" + deck + "'; head -c 600M /dev/zero | tr '\\0' '\\n') | gzip -1 > b.gz"), 0);
  EXPECT_EQ(run("timeout 60 $CONVERT b.gz --format abaqus --max-memory 200MB -o x.zoo"
                " --json facts.json"),
            3);
  expect_end_at_the_limit("b.gz");
  EXPECT_EQ(run("ls | grep -v txt | xargs"), 0);
  EXPECT_EQ(bytes_of(file("out.txt")), "b.gz facts.json m.zoo\n") << "temporary files are left";
}

TEST_F(HostileInputs, UnpackedGzipTakesItsMemoryOnce) {
  // 300 MB of comments are read within 400 MB; the address sanitizer needs more for its own
  ASSERT_EQ(run("(printf '*NODE\\n1,0,0,0\\n2,1,0,0\\n3,0,1,0\\n4,0,0,1\\n"
                "*ELEMENT,TYPE=C3D4\\n1,1,2,3,4\\n';"
                " yes '** '\"$(seq -s ' ' 300)\" | head -c 300M; echo) | gzip -1 > b.gz"),
            0);
  const std::string limit = test::kInstrumented ? "600MB" : "400MB";
  EXPECT_EQ(run("ASAN_OPTIONS=quarantine_size_mb=1 timeout 120 $CONVERT b.gz --format abaqus "
                "--max-memory " +
                limit + " -o x.zoo"),
            0)
      << complaint();
}

TEST_F(HostileInputs, BlocksOfZerosEndAtTheLimitOfMemory) {
  write_zeros("z.vtu", 2000);
  ASSERT_LT(fs::file_size(file("z.vtu")), 4U << 20);
  EXPECT_EQ(run("timeout 60 $CONVERT z.vtu --max-memory 200MB -o x.zoo --json facts.json"), 3);
  expect_end_at_the_limit("z.vtu");
  EXPECT_FALSE(fs::exists(file("x.zoo")));
  write_zeros("z.vtu", 2);
  EXPECT_EQ(run("$CONVERT z.vtu --max-memory 200MB -o x.zoo"), 0)
      << "the file is not sound: " << complaint();
}

TEST_F(HostileInputs, AReportOnStdoutTellsOfTheLimit) {
  ASSERT_EQ(run("head -c 600M /dev/zero | gzip -1 > b.gz"), 0);
  EXPECT_EQ(run("$CONVERT b.gz --format abaqus --list --max-memory 100MB --json -"), 3);
  EXPECT_THAT(bytes_of(file("out.txt")), HasSubstr("\"exit_code\": 3"));
}

TEST_F(HostileInputs, EveryFormatOfOneFileIsReadFromPipes) {
  for (const char* format : {"vtu", "vtkhdf", "gmsh"}) {
    SCOPED_TRACE(format);
    const std::string name = std::string("m.") + (format == std::string("gmsh") ? "msh" : format);
    ASSERT_EQ(run("$CONVERT m.zoo -o " + name + " && $CONVERT " + name + " -o direct.zoo"), 0)
        << complaint();
    EXPECT_EQ(run("$CONVERT - --format " + std::string(format) + " -o a.zoo < " + name), 0)
        << complaint();
    EXPECT_EQ(run("cat " + name + " | $CONVERT --format " + format + " -o b.zoo"), 0)
        << complaint();
    EXPECT_EQ(run("rm -f pipe; mkfifo pipe; cat " + name + " > pipe & timeout 20 $CONVERT pipe" +
                  " -o c.zoo; s=$?; wait; exit $s"),
              0)
        << complaint();
    EXPECT_EQ(run("export CONVERT; bash -c '$CONVERT <(cat " + name + ") -o d.zoo'"), 0)
        << complaint();
    for (const char* read : {"a.zoo", "b.zoo", "c.zoo", "d.zoo"})
      EXPECT_EQ(hash(read), hash("direct.zoo")) << read;
  }
  EXPECT_EQ(run("echo nonsense > bad; mkfifo p2; cat bad > p2 & timeout 20 $CONVERT p2 -o x.zoo"),
            3);
  EXPECT_THAT(complaint(), HasSubstr("hiac-convert: p2: unknown file format"));
}

TEST_F(HostileInputs, PipesAndDevicesThatAFileNamesAreRefused) {
  ASSERT_EQ(run("mkfifo inner.vtu"), 0);
  write("a.pvd",
        "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"inner.vtu\"/>"
        "</Collection></VTKFile>");
  EXPECT_EQ(run("timeout 20 $CONVERT a.pvd -o x.zoo"), 3);
  EXPECT_THAT(complaint(), HasSubstr("a.pvd: names inner.vtu, which is a pipe or a device"));
  EXPECT_EQ(run("timeout 20 $CONVERT /dev/zero -o x.zoo"), 3);
  EXPECT_THAT(complaint(), HasSubstr("/dev/zero: is a device"));
}

TEST_F(HostileInputs, FilesOutsideTheFolderNeedPermission) {
  ASSERT_EQ(run("mkdir in out && $CONVERT m.zoo -o out/m.vtu && cp out/m.vtu in/m.vtu"), 0);
  const auto collection = [](const std::string& named) {
    return "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"" + named +
           "\"/></Collection></VTKFile>";
  };
  const auto blocks = [](const std::string& named) {
    return "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet><DataSet file=\"" + named +
           "\"/></vtkMultiBlockDataSet></VTKFile>";
  };
  for (const std::string& named : {std::string("../out/m.vtu"), file("out/m.vtu")}) {
    write("in/a.pvd", collection(named));
    write("in/a.vtm", blocks(named));
    for (const std::string input : {"in/a.pvd", "in/a.vtm"}) {
      SCOPED_TRACE(input + " names " + named);
      EXPECT_EQ(run("$CONVERT " + input + " -o x.zoo"), 3);
      EXPECT_THAT(complaint(), AllOf(HasSubstr(input + ": names "), HasSubstr("out/m.vtu"),
                                     HasSubstr("--allow-external reads it")));
      EXPECT_EQ(run("$CONVERT " + input + " --allow-external -o x.zoo"), 0) << complaint();
    }
  }
  write("in/a.pvd", collection("m.vtu"));
  EXPECT_EQ(run("$CONVERT in/a.pvd -o x.zoo && cd in && $CONVERT a.pvd -o ../x.zoo"), 0)
      << complaint();
  // a pipe has no folder
  EXPECT_EQ(run("cd in && $CONVERT --format pvd -o ../x.zoo < a.pvd"), 3);
}

}  // namespace
}  // namespace hiac::test
