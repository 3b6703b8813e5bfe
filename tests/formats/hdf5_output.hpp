#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hiac::formats {

/// Writes an HDF5 file through the library; paths are absolute, and groups on the way are made.
class Hdf5Output {
 public:
  explicit Hdf5Output(const std::string& path);
  ~Hdf5Output();
  Hdf5Output(const Hdf5Output&) = delete;
  Hdf5Output& operator=(const Hdf5Output&) = delete;

  void group(const std::string& name);
  /// A dataset of these extents, or of one if there are none.
  void put(const std::string& name, const std::vector<double>& values,
           std::vector<std::uint64_t> shape = {});
  void put(const std::string& name, const std::vector<float>& values,
           std::vector<std::uint64_t> shape = {});
  void put(const std::string& name, const std::vector<std::int64_t>& values,
           std::vector<std::uint64_t> shape = {});
  void put(const std::string& name, const std::vector<std::uint8_t>& values,
           std::vector<std::uint64_t> shape = {});
  void attribute(const std::string& object, const std::string& name, const std::string& text);
  void attribute(const std::string& object, const std::string& name,
                 const std::vector<double>& values);
  void attribute(const std::string& object, const std::string& name,
                 const std::vector<std::int64_t>& values);

 private:
  std::int64_t file_;
};

}  // namespace hiac::formats
