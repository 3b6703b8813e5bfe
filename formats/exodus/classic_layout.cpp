#include "formats/exodus/classic_layout.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "formats/common/io/printable.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::exodus {
namespace {

constexpr std::uint32_t kDimensionTag = 10;
constexpr std::uint32_t kVariableTag = 11;
constexpr std::uint32_t kAttributeTag = 12;

/// One variable as the header declares it.
struct Variable {
  std::string name;
  bool record = false;      ///< its first dimension is the unlimited one
  std::uint64_t bytes = 0;  ///< of one record, or of all; not padded
  std::uint64_t begin = 0;
};

class Header {
 public:
  Header(std::string_view text, const std::string& subject) : text_(text), subject_(subject) {}

  /// Returns the end of the data.
  std::size_t check() {
    version_ = static_cast<unsigned char>(text_[3]);
    at_ = 4;
    const std::uint64_t streaming = version_ == 5 ? ~std::uint64_t{0} : 0xffffffffU;
    const std::uint64_t records = count();
    read_dimensions();
    skip_attributes();
    const std::vector<Variable> variables = read_variables();
    std::uint64_t record_size = 0;
    const auto record_variables = std::count_if(variables.begin(), variables.end(),
                                                [](const Variable& v) { return v.record; });
    for (const Variable& variable : variables)
      // a single record variable is not padded
      if (variable.record)
        record_size += record_variables == 1 ? variable.bytes : padded(variable.bytes);
    std::uint64_t last = at_;
    for (const Variable& variable : variables) {
      std::uint64_t end = variable.begin + variable.bytes;
      if (variable.record) {
        if (records == 0 || records == streaming) continue;
        if (record_size > 0 && records - 1 > text_.size() / record_size)
          fail(fmt::format("declares {} records, more than it can hold", records));
        end += (records - 1) * record_size;
      }
      if (variable.bytes > text_.size() || variable.begin > text_.size() || end > text_.size())
        fail(fmt::format("ended before the data of '{}' ({} bytes expected, {} found)",
                         variable.name, end, text_.size()));
      last = std::max(last, padded(end));
    }
    // the number of records is unknown while a program still writes them
    if (records == streaming) return text_.size();
    return std::min<std::uint64_t>(last, text_.size());
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const { throw InputError(subject_, problem); }

  static std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

  std::uint64_t number(std::size_t size) {
    if (size > text_.size() - at_) fail("ended in its netCDF header");
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value = value << 8U | static_cast<unsigned char>(text_[at_ + i]);
    at_ += size;
    return value;
  }
  std::uint64_t count() { return number(version_ == 5 ? 8 : 4); }

  void skip(std::uint64_t bytes) {
    if (bytes > text_.size() - at_ || padded(bytes) > text_.size() - at_)
      fail("ended in its netCDF header");
    at_ += padded(bytes);
  }

  std::string name() {
    const std::uint64_t length = count();
    const std::size_t begin = at_;
    skip(length);
    return std::string(text_.substr(begin, length));
  }

  /// The length of a list; every entry takes at least one byte of the file.
  std::uint64_t list(std::uint32_t tag) {
    const std::uint64_t found = number(4);
    const std::uint64_t length = count();
    if ((found != tag && (found != 0 || length != 0)) || length > text_.size())
      fail("has a damaged netCDF header");
    return length;
  }

  std::uint64_t type_bytes() {
    switch (number(4)) {
      case 1:
      case 2:
      case 7:
        return 1;
      case 3:
      case 8:
        return 2;
      case 4:
      case 5:
      case 9:
        return 4;
      case 6:
      case 10:
      case 11:
        return 8;
      default:
        fail("has a damaged netCDF header (unknown type of a variable)");
    }
  }

  void read_dimensions() {
    for (std::uint64_t left = list(kDimensionTag); left > 0; --left) {
      name();
      dimensions_.push_back(count());
    }
  }

  void skip_attributes() {
    for (std::uint64_t left = list(kAttributeTag); left > 0; --left) {
      name();
      const std::uint64_t size = type_bytes();
      const std::uint64_t length = count();
      if (length > text_.size()) fail("ended in its netCDF header");
      skip(size * length);
    }
  }

  std::vector<Variable> read_variables() {
    std::vector<Variable> variables;
    for (std::uint64_t left = list(kVariableTag); left > 0; --left) {
      Variable variable;
      variable.name = printable(name());
      std::uint64_t values = 1;
      const std::uint64_t rank = count();
      for (std::uint64_t d = 0; d < rank; ++d) {
        const std::uint64_t dimension = count();
        if (dimension >= dimensions_.size()) fail("has a damaged netCDF header");
        const std::uint64_t length = dimensions_[dimension];
        if (d == 0 && length == 0)
          variable.record = true;
        else if (__builtin_mul_overflow(values, length, &values))
          fail(fmt::format("declares more values of '{}' than it can hold", variable.name));
      }
      skip_attributes();
      const std::uint64_t size = type_bytes();
      if (values > text_.size())
        fail(fmt::format("ended before the data of '{}' ({} values expected)", variable.name,
                         values));
      variable.bytes = values * size;
      count();  // the variable's size, which follows from the rest
      variable.begin = number(version_ == 1 ? 4 : 8);
      variables.push_back(std::move(variable));
    }
    return variables;
  }

  std::string_view text_;
  std::string subject_;
  unsigned version_ = 0;
  std::size_t at_ = 0;
  std::vector<std::uint64_t> dimensions_;
};

}  // namespace

bool is_classic_netcdf(std::string_view head) {
  return head.size() > 4 && head.starts_with("CDF") &&
         (head[3] == 1 || head[3] == 2 || head[3] == 5);
}

std::size_t check_classic_layout(std::string_view text, const std::string& subject) {
  return Header(text, subject).check();
}

}  // namespace hiac::formats::exodus
