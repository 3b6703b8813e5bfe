#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hiac::formats::exodus {

/// A netCDF file for reading: names in, numbers out. For use in a process that may crash
/// (read_isolated). Every function throws InputError naming the file and the variable; memory is
/// allocated only when the file is large enough for the data.
class NetcdfFile {
 public:
  explicit NetcdfFile(const std::string& path);
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  /// The length of a dimension; 0 when there is none with that name.
  [[nodiscard]] std::size_t dimension(const std::string& name) const;
  [[nodiscard]] bool has(const std::string& variable) const;
  [[nodiscard]] std::vector<std::size_t> shape(const std::string& variable) const;
  /// "double", "float", "int32", ...
  [[nodiscard]] std::string type(const std::string& variable) const;

  /// All numbers of a variable.
  [[nodiscard]] std::vector<double> reals(const std::string& variable) const;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& variable) const;
  /// The part that begins at `start` and has `count` entries along every dimension.
  [[nodiscard]] std::vector<double> reals(const std::string& variable,
                                          const std::vector<std::size_t>& start,
                                          const std::vector<std::size_t>& count) const;
  /// The lines of a two-dimensional array of characters; none where there is no such variable.
  [[nodiscard]] std::vector<std::string> texts(const std::string& variable) const;
  /// A text attribute of a variable; of the file when the variable's name is empty.
  [[nodiscard]] std::optional<std::string> text_attribute(const std::string& variable,
                                                          const std::string& name) const;

  /// The size of what follows the data of a classic file; 0 for netCDF-4, which is HDF5.
  [[nodiscard]] std::uint64_t bytes_behind() const { return bytes_behind_; }

  [[noreturn]] void fail(const std::string& variable, std::string_view problem) const;

 private:
  [[nodiscard]] int id_of(const std::string& variable) const;
  /// The number of values, after checking that the file can hold so many.
  [[nodiscard]] std::size_t checked_size(const std::string& variable) const;

  std::string path_;
  std::uint64_t file_size_ = 0;
  std::uint64_t bytes_behind_ = 0;
  bool packed_ = false;  ///< netCDF-4, which may be compressed
  int file_ = -1;
};

/// "netCDF 4.9.0"
std::string library_version();

}  // namespace hiac::formats::exodus
