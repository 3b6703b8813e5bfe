#include "formats/hdf5/external_files.hpp"

#include <array>
#include <string>

#include <gmock/gmock.h>
#include <hdf5.h>

#include "formats/common/io/named_file.hpp"
#include "hiac/base/error.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::array<hsize_t, 1> kSize{4};

hid_t created(const std::string& path) {
  return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
}

std::string linked(const std::string& path, const std::string& target) {
  const hid_t file = created(path);
  const hid_t group = H5Gcreate2(file, "a", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Lcreate_external(target.c_str(), "/x", group, "b", H5P_DEFAULT, H5P_DEFAULT), 0);
  H5Gclose(group);
  H5Fclose(file);
  return path;
}

/// A file with one dataset of that creation list, which is closed.
std::string with_dataset(const std::string& path, hid_t properties) {
  const hid_t file = created(path);
  const hid_t space = H5Screate_simple(1, kSize.data(), nullptr);
  const hid_t dataset =
      H5Dcreate2(file, "/x", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  EXPECT_GE(dataset, 0);
  H5Dclose(dataset);
  H5Sclose(space);
  if (properties != H5P_DEFAULT) H5Pclose(properties);
  H5Fclose(file);
  return path;
}

void expect_refused(const std::string& path, const std::string& named) {
  EXPECT_THAT([&] { hdf5::require_local_links(path); },
              ThrowsMessage<InputError>(testing::AllOf(HasSubstr("names "), HasSubstr(named),
                                                       HasSubstr("outside the input's folder"))));
}

class ExternalFiles : public testing::Test {
 protected:
  void TearDown() override { set_named_files({}); }
  ScratchFolder outside_;
  ScratchFolder folder_;
};

TEST_F(ExternalFiles, FilesInTheFolderMayBeNamed) {
  with_dataset(folder_.file("b.h5"), H5P_DEFAULT);
  EXPECT_NO_THROW(hdf5::require_local_links(linked(folder_.file("a.h5"), "b.h5")));
  EXPECT_NO_THROW(hdf5::require_local_links(linked(folder_.file("a.h5"), "./x/../b.h5")));
  EXPECT_NO_THROW(hdf5::require_local_links(linked(folder_.file("a.h5"), folder_.file("b.h5"))));
  EXPECT_NO_THROW(hdf5::require_local_links(linked(folder_.file("a.h5"), "not-there.h5")));
  EXPECT_NO_THROW(hdf5::require_local_links(folder_.write("text", "no HDF5 at all")));
}

TEST_F(ExternalFiles, ExternalLinksToOtherFoldersAreRefused) {
  const std::string secret = with_dataset(outside_.file("secret.h5"), H5P_DEFAULT);
  expect_refused(linked(folder_.file("a.h5"), secret), secret);
  expect_refused(linked(folder_.file("a.h5"), "../secret.h5"), "/secret.h5");
  set_named_files({"", true});
  EXPECT_NO_THROW(hdf5::require_local_links(folder_.file("a.h5")));
}

TEST_F(ExternalFiles, LinksOfLinkedFilesAreLookedAt) {
  const std::string secret = with_dataset(outside_.file("secret.h5"), H5P_DEFAULT);
  linked(folder_.file("b.h5"), secret);
  expect_refused(linked(folder_.file("a.h5"), "b.h5"), secret);
  linked(folder_.file("d.h5"), "c.h5");
  EXPECT_NO_THROW(hdf5::require_local_links(linked(folder_.file("c.h5"), "d.h5")));  // a ring
}

TEST_F(ExternalFiles, StoredAndVirtualDataElsewhereAreRefused) {
  const std::string secret = outside_.write("secret.raw", std::string(32, 'x'));
  const hid_t stored = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_external(stored, secret.c_str(), 0, 32);
  expect_refused(with_dataset(folder_.file("s.h5"), stored), secret);
  const hid_t virtual_one = H5Pcreate(H5P_DATASET_CREATE);
  const hid_t space = H5Screate_simple(1, kSize.data(), nullptr);
  H5Pset_virtual(virtual_one, space, secret.c_str(), "/x", space);
  H5Sclose(space);
  expect_refused(with_dataset(folder_.file("v.h5"), virtual_one), secret);
}

TEST_F(ExternalFiles, NamesAreJudgedByTheInputsFolder) {
  const std::string sub = folder_.file("sub/a.pvd");
  EXPECT_THAT([&] { file_beside(sub, "../b.vtu"); },
              ThrowsMessage<InputError>(HasSubstr("outside the input's folder")));
  set_named_files({folder_.file(""), false});
  EXPECT_NO_THROW(file_beside(sub, "../b.vtu"));
  EXPECT_THAT([&] { file_beside(sub, "../../b.vtu"); },
              ThrowsMessage<InputError>(HasSubstr("outside the input's folder")));
  const std::string beside = folder_.file("").substr(0, folder_.file("").size() - 1) + "-2/b.vtu";
  EXPECT_THAT([&] { file_beside(sub, beside); },
              ThrowsMessage<InputError>(HasSubstr("NamedFiles::outside_too reads it")));
}

}  // namespace
}  // namespace hiac::formats
