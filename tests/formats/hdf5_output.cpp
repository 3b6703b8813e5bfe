#include "tests/formats/hdf5_output.hpp"

#include <stdexcept>

#include <hdf5.h>

namespace hiac::formats {
namespace {

hid_t checked(hid_t id) {
  if (id < 0) throw std::runtime_error("HDF5 refuses what the test writes");
  return id;
}

void write(hid_t file, const std::string& name, hid_t type, const void* values, std::size_t count,
           std::vector<std::uint64_t> shape) {
  if (shape.empty()) shape = {count};
  const std::vector<hsize_t> extents(shape.begin(), shape.end());
  const hid_t space =
      checked(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr));
  const hid_t links = checked(H5Pcreate(H5P_LINK_CREATE));
  checked(H5Pset_create_intermediate_group(links, 1));
  const hid_t dataset =
      checked(H5Dcreate2(file, name.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT));
  checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
  H5Dclose(dataset);
  H5Pclose(links);
  H5Sclose(space);
}

void write_attribute(hid_t file, const std::string& object, const std::string& name, hid_t type,
                     hid_t space, const void* values) {
  const hid_t owner = checked(H5Oopen(file, object.c_str(), H5P_DEFAULT));
  const hid_t attribute =
      checked(H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
  checked(H5Awrite(attribute, type, values));
  H5Aclose(attribute);
  H5Oclose(owner);
}

void write_list(hid_t file, const std::string& object, const std::string& name, hid_t type,
                std::size_t count, const void* values) {
  const hsize_t extent = count;
  const hid_t space = checked(H5Screate_simple(1, &extent, nullptr));
  write_attribute(file, object, name, type, space, values);
  H5Sclose(space);
}

}  // namespace

Hdf5Output::Hdf5Output(const std::string& path)
    : file_(checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT))) {}

Hdf5Output::~Hdf5Output() { H5Fclose(file_); }

void Hdf5Output::group(const std::string& name) {
  H5Gclose(checked(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)));
}

void Hdf5Output::put(const std::string& name, const std::vector<double>& values,
                     std::vector<std::uint64_t> shape) {
  write(file_, name, H5T_NATIVE_DOUBLE, values.data(), values.size(), std::move(shape));
}
void Hdf5Output::put(const std::string& name, const std::vector<float>& values,
                     std::vector<std::uint64_t> shape) {
  write(file_, name, H5T_NATIVE_FLOAT, values.data(), values.size(), std::move(shape));
}
void Hdf5Output::put(const std::string& name, const std::vector<std::int64_t>& values,
                     std::vector<std::uint64_t> shape) {
  write(file_, name, H5T_NATIVE_INT64, values.data(), values.size(), std::move(shape));
}
void Hdf5Output::put(const std::string& name, const std::vector<std::uint8_t>& values,
                     std::vector<std::uint64_t> shape) {
  write(file_, name, H5T_NATIVE_UINT8, values.data(), values.size(), std::move(shape));
}

void Hdf5Output::attribute(const std::string& object, const std::string& name,
                           const std::string& text) {
  const hid_t type = checked(H5Tcopy(H5T_C_S1));
  checked(H5Tset_size(type, text.size()));
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD));
  const hid_t space = checked(H5Screate(H5S_SCALAR));
  write_attribute(file_, object, name, type, space, text.data());
  H5Sclose(space);
  H5Tclose(type);
}
void Hdf5Output::attribute(const std::string& object, const std::string& name,
                           const std::vector<double>& values) {
  write_list(file_, object, name, H5T_NATIVE_DOUBLE, values.size(), values.data());
}
void Hdf5Output::attribute(const std::string& object, const std::string& name,
                           const std::vector<std::int64_t>& values) {
  write_list(file_, object, name, H5T_NATIVE_INT64, values.size(), values.data());
}

}  // namespace hiac::formats
