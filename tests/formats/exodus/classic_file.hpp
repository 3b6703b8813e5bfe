#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace hiac::formats {

/// A classic netCDF file byte by byte ("NetCDF Classic Format Specification"), so that any of its
/// numbers can be a wrong one. Versions 1, 2 and 5.
class ClassicFile {
 public:
  explicit ClassicFile(unsigned version = 1) : version_(version) {}

  static std::string big_endian(std::uint64_t value, std::size_t bytes) {
    std::string text;
    for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * (bytes - 1 - i));
    return text;
  }
  [[nodiscard]] std::string count(std::uint64_t value) const {
    return big_endian(value, version_ == 5 ? 8 : 4);
  }
  static std::string padded(std::string bytes) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    return bytes;
  }
  [[nodiscard]] std::string name(const std::string& text) const {
    return count(text.size()) + padded(text);
  }

  /// A dimension; of length 0: the unlimited one. Returns its number.
  std::size_t dimension(const std::string& name, std::uint64_t length) {
    dimensions_.emplace_back(name, length);
    return dimensions_.size() - 1;
  }
  void ints(const std::string& name, const std::vector<std::size_t>& along,
            const std::vector<std::int32_t>& values, const std::string& element = "") {
    std::string data;
    for (const std::int32_t value : values)
      data += big_endian(static_cast<std::uint32_t>(value), 4);
    variable(name, along, 4, data, element);
  }
  void doubles(const std::string& name, const std::vector<std::size_t>& along,
               const std::vector<double>& values) {
    std::string data;
    for (const double value : values) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      data += big_endian(bits, 8);
    }
    variable(name, along, 6, data);
  }
  /// `type`: 1 byte, 2 char, 3 short, 4 int, 5 float, 6 double, and in version 5 up to 11.
  void variable(const std::string& name, const std::vector<std::size_t>& along, std::uint32_t type,
                const std::string& data, const std::string& element = "") {
    variables_.push_back({name, along, type, data, element});
  }

  /// The number of records that the file declares; their data are those of the variables.
  std::uint64_t records = 0;

  [[nodiscard]] std::string bytes() const {
    const std::size_t header = head({}).size();
    std::vector<std::uint64_t> begins;
    std::string data;
    for (const Variable& variable : variables_) {
      begins.push_back(header + data.size());
      data += padded(variable.data);
    }
    return head(begins) + data;
  }

 private:
  struct Variable {
    std::string name;
    std::vector<std::size_t> along;
    std::uint32_t type;
    std::string data;
    std::string element;
  };

  [[nodiscard]] std::string list(std::uint32_t tag, std::size_t length) const {
    return big_endian(length == 0 ? 0 : tag, 4) + count(length);
  }

  [[nodiscard]] std::string head(const std::vector<std::uint64_t>& begins) const {
    std::string text = "CDF" + std::string(1, static_cast<char>(version_)) + count(records);
    text += list(10, dimensions_.size());
    for (const auto& [dimension, length] : dimensions_) text += name(dimension) + count(length);
    text += list(12, 0) + list(11, variables_.size());
    for (std::size_t v = 0; v < variables_.size(); ++v) {
      const Variable& variable = variables_[v];
      text += name(variable.name) + count(variable.along.size());
      for (const std::size_t dimension : variable.along) text += count(dimension);
      text += list(12, variable.element.empty() ? 0 : 1);
      if (!variable.element.empty())
        text += name("elem_type") + big_endian(2, 4) + name(variable.element);
      text += big_endian(variable.type, 4) + count(padded(variable.data).size());
      text += big_endian(begins.empty() ? 0 : begins[v], version_ == 1 ? 4 : 8);
    }
    return text;
  }

  unsigned version_;
  std::vector<std::pair<std::string, std::uint64_t>> dimensions_;
  std::vector<Variable> variables_;
};

}  // namespace hiac::formats
