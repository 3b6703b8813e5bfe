#include "formats/hdf5/external_files.hpp"

#include <array>
#include <filesystem>
#include <set>
#include <vector>

#include <hdf5.h>

#include "formats/common/io/named_file.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::hdf5 {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

constexpr std::size_t kLongestName = 4096;
/// Limits the files that refer to each other; a simulation does not write more.
constexpr std::size_t kMostFiles = 10'000;

herr_t add_link(hid_t group, const char* name, const H5L_info_t* info, void* names) {
  if (info->type != H5L_TYPE_EXTERNAL) return 0;
  std::vector<char> value(info->u.val_size);
  const char* file = nullptr;
  const char* object = nullptr;
  if (H5Lget_val(group, name, value.data(), value.size(), H5P_DEFAULT) >= 0 &&
      H5Lunpack_elink_val(value.data(), value.size(), nullptr, &file, &object) >= 0)
    static_cast<Names*>(names)->emplace_back(file);
  return 0;
}

void add_storage(hid_t properties, Names& names) {
  const int stored = H5Pget_external_count(properties);
  for (int i = 0; i < stored; ++i) {
    std::array<char, kLongestName> name{};
    off_t offset = 0;
    hsize_t size = 0;
    if (H5Pget_external(properties, static_cast<unsigned>(i), name.size() - 1, name.data(), &offset,
                        &size) >= 0)
      names.emplace_back(name.data());
  }
  std::size_t parts = 0;
  if (H5Pget_layout(properties) != H5D_VIRTUAL || H5Pget_virtual_count(properties, &parts) < 0)
    return;
  for (std::size_t i = 0; i < parts; ++i) {
    std::array<char, kLongestName> name{};
    if (H5Pget_virtual_filename(properties, i, name.data(), name.size() - 1) > 0)
      names.emplace_back(name.data());
  }
}

herr_t add_dataset(hid_t group, const char* name, const H5O_info_t* info, void* names) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const hid_t dataset = H5Dopen2(group, name, H5P_DEFAULT);
  if (dataset < 0) return 0;
  const hid_t properties = H5Dget_create_plist(dataset);
  if (properties >= 0) add_storage(properties, *static_cast<Names*>(names));
  H5Pclose(properties);
  H5Dclose(dataset);
  return 0;
}

/// The files that a file refers to, as it names them.
Names named_by(const std::string& path) {
  Names names;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return names;
  H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, add_link, &names);
  H5Ovisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, add_dataset, &names);
  H5Fclose(file);
  return names;
}

}  // namespace

void require_local_links(const std::string& path) {
  std::set<std::string> known{path};
  Names left{path};
  while (!left.empty() && known.size() < kMostFiles) {
    const std::string from = left.back();
    left.pop_back();
    for (const std::string& name : named_by(from)) {
      if (name == ".") continue;  // a virtual dataset's own file
      const std::string beside = file_beside(from, name);
      std::error_code error;
      // if there is no such file beside this one, the library looks in the current folder
      if (!fs::exists(beside, error) && fs::exists(name, error)) require_local(from, name);
      if (fs::exists(beside, error) && known.insert(beside).second) left.push_back(beside);
    }
  }
}

}  // namespace hiac::formats::hdf5
