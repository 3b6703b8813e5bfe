// Names in, numbers out: what is said of names that are not there and of arrays of another form,
// and parts of arrays.
#include "formats/hdf5/hdf5_file.hpp"

#include <array>

#include <hdf5.h>

#include "tests/formats/files.hpp"
#include "tests/formats/hdf5_output.hpp"

namespace hiac::formats::hdf5 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Hdf5Names : public testing::Test {
 protected:
  Hdf5Names() : path_(folder_.file("a.h5")) {
    Hdf5Output out(path_);
    out.put("/group/table", std::vector<std::int64_t>{11, 12, 13, 21, 22, 23}, {2, 3});
    out.put("/group/reals", std::vector<double>{0.5, 1.5, 2.5});
    out.put("/group/texts", std::vector<std::uint8_t>{'a', 'b', ' ', 'c', 0, 'd'}, {2, 3});
    out.put("/group/bytes", std::vector<std::uint8_t>{1, 2, 3});
    out.put("/other/floats", std::vector<float>{1});
    out.attribute("/group", "text", std::string("some text  "));
    out.attribute("/group", "numbers", std::vector<std::int64_t>{7, 8});
    out.attribute("/group", "reals", std::vector<double>{0.25});
  }

  template <typename Read>
  [[nodiscard]] std::string complaint(const Read& read) const {
    try {
      const File file(path_);
      read(file);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(path_.size() + 2);
    }
    return "none";
  }

  ScratchFolder folder_;
  std::string path_;
};

TEST_F(Hdf5Names, GroupsAndWhatIsInThem) {
  const File file(path_);
  EXPECT_EQ(file.path(), path_);
  EXPECT_TRUE(file.has("/"));
  EXPECT_TRUE(file.has("/group"));
  EXPECT_TRUE(file.has("/group/table"));
  EXPECT_FALSE(file.has("/group/chair"));
  EXPECT_FALSE(file.has("/nothing/table"));
  EXPECT_TRUE(file.is_group("/group"));
  EXPECT_FALSE(file.is_group("/group/table"));
  EXPECT_FALSE(file.is_group("/nothing"));
  EXPECT_THAT(file.children("/"), ElementsAre("group", "other"));
  EXPECT_THAT(file.children("/group"), ElementsAre("bytes", "reals", "table", "texts"));
  EXPECT_THAT(file.info("/group/table").shape, ElementsAre(2, 3));
  EXPECT_EQ(file.info("/group/table").size(), 6U);
  EXPECT_EQ(file.info("/group/table").type, "int64");
  EXPECT_EQ(file.info("/group/bytes").type, "uint8");
  EXPECT_EQ(file.info("/other/floats").type, "float32");
}

TEST_F(Hdf5Names, NamesThatAreNotThere) {
  EXPECT_EQ(complaint([](const File& file) { (void)file.children("/none"); }),
            "/none: no such group");
  EXPECT_EQ(complaint([](const File& file) { (void)file.children("/group/table"); }),
            "/group/table: no such group");
  EXPECT_EQ(complaint([](const File& file) { (void)file.info("/group"); }),
            "/group: no such dataset");
  EXPECT_EQ(complaint([](const File& file) { (void)file.info("/group/none"); }),
            "/group/none: no such dataset");
  EXPECT_EQ(complaint([](const File& file) { (void)file.reals("/none/at/all"); }),
            "/none/at/all: no such dataset");
  EXPECT_EQ(complaint([](const File& file) { (void)file.texts("/group/none"); }),
            "/group/none: no such dataset");
}

TEST_F(Hdf5Names, PartsOfTables) {
  const File file(path_);
  EXPECT_THAT(file.integers("/group/table"), ElementsAre(11, 12, 13, 21, 22, 23));
  EXPECT_THAT(file.integers("/group/table", {{0, 1}, {2, 2}}), ElementsAre(12, 13, 22, 23));
  EXPECT_THAT(file.integers("/group/table", {{1, 0}, {1, 3}}), ElementsAre(21, 22, 23));
  EXPECT_THAT(file.integers("/group/table", {{2, 3}, {0, 0}}), IsEmpty());
  EXPECT_THAT(file.reals("/group/reals", {{1}, {2}}), ElementsAre(1.5, 2.5));
  EXPECT_THAT(file.reals("/group/bytes"), ElementsAre(1, 2, 3));
  const auto part = [&](const Slab& slab) {
    return complaint([&](const File& f) { (void)f.integers("/group/table", slab); });
  };
  EXPECT_EQ(part({{0}, {2}}), "/group/table: has 2 dimensions (1 expected)");
  EXPECT_EQ(part({{0, 0}, {1}}), "/group/table: has 2 dimensions (2 expected)");
  EXPECT_EQ(part({{0, 0}, {3, 3}}), "/group/table: holds 2 along dimension 0 (3 expected)");
  EXPECT_EQ(part({{0, 2}, {2, 2}}), "/group/table: holds 3 along dimension 1 (4 expected)");
  EXPECT_EQ(part({{3, 0}, {0, 3}}), "/group/table: holds 2 along dimension 0 (3 expected)");
}

TEST_F(Hdf5Names, TextsOfFixedLength) {
  const File file(path_);
  EXPECT_THAT(file.texts("/group/texts"), ElementsAre("ab", "c"));
  EXPECT_EQ(complaint([](const File& f) { (void)f.texts("/group/bytes"); }),
            "/group/bytes: holds no texts of fixed length");
  EXPECT_EQ(complaint([](const File& f) { (void)f.texts("/group/table"); }),
            "/group/table: holds no texts of fixed length");
}

TEST_F(Hdf5Names, AttributesOfEveryKind) {
  const File file(path_);
  EXPECT_TRUE(file.has_attribute("/group", "text"));
  EXPECT_FALSE(file.has_attribute("/group", "none"));
  EXPECT_FALSE(file.has_attribute("/none", "text"));
  EXPECT_EQ(file.text_attribute("/group", "text"), "some text");
  EXPECT_EQ(file.text_attribute("/group", "numbers"), std::nullopt);
  EXPECT_EQ(file.text_attribute("/group", "none"), std::nullopt);
  EXPECT_EQ(file.integer_attribute("/group", "numbers"), 7);
  EXPECT_EQ(file.integer_attribute("/group", "text"), std::nullopt);
  EXPECT_EQ(file.integer_attribute("/group", "none"), std::nullopt);
  EXPECT_THAT(file.real_attribute("/group", "numbers"), ElementsAre(7, 8));
  EXPECT_THAT(file.real_attribute("/group", "reals"), ElementsAre(0.25));
  EXPECT_THAT(file.real_attribute("/group", "text"), IsEmpty());
}

TEST(Hdf5Files, ThatTheLibraryCannotOpen) {
  const ScratchFolder folder;
  const auto complaint = [](const std::string& path) -> std::string {
    try {
      const File file(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  const std::string path =
      folder.write("a.h5", std::string("\x89HDF\r\n\x1a\n", 8) + "and no more");
  EXPECT_EQ(complaint(path), path + ": is no whole HDF5 file (the library cannot open it)");
  const std::string none = folder.file("none.h5");
  EXPECT_EQ(complaint(none), none + ": cannot be read (No such file or directory)");
}

// What is declared has to be in the file, though packed by any filter.
TEST(Hdf5Files, DeclareNoMoreThanTheyHold) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.h5");
  const auto said = [&](hsize_t count, bool packed) -> std::string {
    const hid_t out = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    if (packed) {
      EXPECT_GE(H5Pset_chunk(properties, 1, &count), 0);
      EXPECT_GE(H5Pset_deflate(properties, 9), 0);
    }
    const hid_t set =
        H5Dcreate2(out, "/x", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    // without values, nothing is stored
    if (packed) {
      const std::vector<double> zeros(count, 0);
      EXPECT_GE(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, zeros.data()), 0);
    }
    H5Dclose(set);
    H5Pclose(properties);
    H5Sclose(space);
    H5Fclose(out);
    try {
      const File file(path);
      EXPECT_EQ(file.reals("/x").size(), count);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(path.size() + 2);
    }
    return "none";
  };
  EXPECT_EQ(said(100'000, true), "none");
  EXPECT_EQ(said(100'000, false), "/x: declares 800000 bytes where the file holds 0");
  EXPECT_EQ(said(1, false), "none");
}

TEST(Hdf5Files, TextsOfVariableLength) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.h5");
  {
    const hid_t out = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    for (const auto& [name, set] : {std::pair{"ascii", H5T_CSET_ASCII}, {"utf8", H5T_CSET_UTF8}}) {
      const hid_t type = H5Tcopy(H5T_C_S1);
      EXPECT_GE(H5Tset_size(type, H5T_VARIABLE), 0);
      EXPECT_GE(H5Tset_cset(type, set), 0);
      for (const hsize_t count : {1, 2}) {
        const hid_t space = H5Screate_simple(1, &count, nullptr);
        const std::string attribute = name + std::to_string(count);
        const hid_t id = H5Acreate2(out, attribute.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
        const std::array<const char*, 2> texts{"some words  ", "more"};
        EXPECT_GE(H5Awrite(id, type, texts.data()), 0);
        H5Aclose(id);
        H5Sclose(space);
      }
      H5Tclose(type);
    }
    H5Fclose(out);
  }
  const File file(path);
  for (const std::string name : {"ascii", "utf8"}) {
    EXPECT_EQ(file.text_attribute("/", name + "1"), "some words") << name;
    EXPECT_EQ(file.text_attribute("/", name + "2"), std::nullopt) << name;
  }
}

TEST(Hdf5Files, PackedDataThatAreDamaged) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.h5");
  {
    const hsize_t count = 4096;
    std::vector<double> values;
    for (hsize_t i = 0; i < count; ++i) values.push_back(static_cast<double>(i * i % 977));
    const hid_t out = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(properties, 1, &count);
    H5Pset_deflate(properties, 6);
    const hid_t set =
        H5Dcreate2(out, "/x", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    EXPECT_GE(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    H5Dclose(set);
    H5Pclose(properties);
    H5Sclose(space);
    H5Fclose(out);
    EXPECT_EQ(File(path).reals("/x"), values);
  }
  // the head of zlib's data
  std::string text = text_of(path);
  const std::size_t packed = text.find("\x78\x9c");
  ASSERT_NE(packed, std::string::npos);
  text.replace(packed + 2, 8, std::string(8, '\xff'));
  static_cast<void>(folder.write("a.h5", text));
  try {
    static_cast<void>(File(path).reals("/x"));
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), path +
                                ": /x: cannot be read (damaged, or packed by a filter that is "
                                "not here)");
  }
}

}  // namespace
}  // namespace hiac::formats::hdf5
