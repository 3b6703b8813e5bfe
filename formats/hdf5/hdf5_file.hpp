#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hiac::formats::hdf5 {

/// A part of a dataset: its beginning and its extent in every dimension.
struct Slab {
  std::vector<std::uint64_t> begin;
  std::vector<std::uint64_t> count;
};

/// A dataset's extents and number type.
struct DatasetInfo {
  std::vector<std::uint64_t> shape;
  std::string type;  ///< "float64", "int32", "uint8", "text", "other"
  [[nodiscard]] std::uint64_t size() const;
};

/// An HDF5 file for reading: names in, numbers out. For use in a process that may crash
/// (read_isolated). Every function throws InputError naming the file and the object; memory is
/// allocated only when the file is large enough to hold what a dataset declares.
class File {
 public:
  explicit File(const std::string& path);
  ~File();
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

  /// Whether there is a group or dataset with that name. Names are paths: "/a/b".
  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] bool is_group(const std::string& name) const;
  /// The names of a group's members, in alphabetical order, without the path of the group.
  [[nodiscard]] std::vector<std::string> children(const std::string& group) const;

  [[nodiscard]] DatasetInfo info(const std::string& dataset) const;
  [[nodiscard]] std::vector<double> reals(const std::string& dataset) const;
  [[nodiscard]] std::vector<double> reals(const std::string& dataset, const Slab& slab) const;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& dataset) const;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& dataset,
                                                   const Slab& slab) const;

  /// The texts of a dataset of strings or of rows of characters.
  [[nodiscard]] std::vector<std::string> texts(const std::string& dataset) const;

  [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const;
  /// The attribute's numbers, or nothing when there is no such attribute.
  [[nodiscard]] std::vector<double> real_attribute(const std::string& object,
                                                   const std::string& name) const;
  [[nodiscard]] std::optional<std::int64_t> integer_attribute(const std::string& object,
                                                              const std::string& name) const;
  [[nodiscard]] std::optional<std::string> text_attribute(const std::string& object,
                                                          const std::string& name) const;

  [[noreturn]] void fail(const std::string& object, std::string_view problem) const;

 private:
  std::string path_;
  std::uint64_t file_size_ = 0;
  std::int64_t file_ = -1;

  template <typename T>
  std::vector<T> read(const std::string& dataset, const Slab* slab, std::int64_t type) const;
  void require_stored(std::int64_t dataset, const std::string& name) const;
};

/// "HDF5 1.10.8"
std::string library_version();

}  // namespace hiac::formats::hdf5
