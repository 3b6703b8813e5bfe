#include "formats/ensight/gold_file.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats::ensight {
namespace {

constexpr std::size_t kTextBytes = 80;
/// No file has more parts: a larger number is one of the other byte order.
constexpr std::int64_t kMostParts = 65'535;

}  // namespace

GoldFile::GoldFile(const std::string& path, bool binary, bool swap)
    : input_(std::make_shared<InputText>(path)),
      cursor_(input_->text(), path),
      binary_(binary),
      swap_(swap),
      order_known_(true) {}

GoldFile GoldFile::open_geometry(const std::string& path) {
  GoldFile file(path, false, false);
  const std::string_view all = file.cursor_.text();
  if (all.starts_with("Fortran Binary"))
    throw InputError(path, "is a Fortran binary file (ASCII or C Binary expected)");
  file.binary_ = all.starts_with("C Binary");
  file.order_known_ = !file.binary_;
  if (file.binary_) file.text();
  return file;
}

void GoldFile::fail(const std::string& problem) const {
  if (!binary_) cursor_.fail(problem);
  throw InputError(fmt::format("{}: byte {}", cursor_.subject(), cursor_.offset()), problem);
}

bool GoldFile::at_end() {
  if (!binary_) cursor_.skip_space();
  return cursor_.at_end();
}

std::string GoldFile::text(bool peek) {
  const std::size_t before = cursor_.offset();
  std::string result;
  if (binary_) {
    if (cursor_.left() < kTextBytes) fail("ended in a text");
    const std::string_view raw = cursor_.text().substr(before, kTextBytes);
    result = std::string(trimmed(raw.substr(0, raw.find('\0'))));
    cursor_.move_to(before + kTextBytes);
  } else {
    result = std::string(trimmed(cursor_.line()));
  }
  if (peek) cursor_.move_to(before);
  return result;
}

std::uint32_t GoldFile::word() {
  if (cursor_.left() < 4) fail("ended in a number");
  std::uint32_t value = 0;
  std::memcpy(&value, cursor_.text().data() + cursor_.offset(), sizeof value);
  cursor_.move_to(cursor_.offset() + sizeof value);
  return swap_ ? __builtin_bswap32(value) : value;
}

std::int64_t GoldFile::whole() { return wholes(1).front(); }

std::size_t GoldFile::count(std::size_t bytes_each) {
  const std::int64_t value = whole();
  const std::size_t most = cursor_.left() / (binary_ ? bytes_each : 2);
  if (value < 0 || static_cast<std::uint64_t>(value) > most)
    fail(fmt::format("a count that fits the file expected (at most {}; {} found)", most, value));
  return static_cast<std::size_t>(value);
}

std::int64_t GoldFile::part_number() {
  const std::size_t before = cursor_.offset();
  std::int64_t value = whole();
  if (!order_known_ && (value < 1 || value > kMostParts)) {
    swap_ = !swap_;
    cursor_.move_to(before);
    value = whole();
  }
  order_known_ = true;
  if (value < 1 || value > kMostParts)
    fail(fmt::format("the number of a part expected ({} found)", value));
  return value;
}

std::vector<std::int64_t> GoldFile::wholes(std::size_t amount) {
  if (amount > cursor_.left() / (binary_ ? 4 : 1)) fail("ended in a list of numbers");
  std::vector<std::int64_t> values;
  values.reserve(amount);
  for (std::size_t i = 0; i < amount; ++i)
    values.push_back(binary_ ? std::bit_cast<std::int32_t>(word())
                             : cursor_.integer("a whole number"));
  if (!binary_ && amount > 0) cursor_.line();
  return values;
}

std::vector<double> GoldFile::reals(std::size_t amount) {
  if (amount > cursor_.left() / (binary_ ? 4 : 1)) fail("ended in a list of numbers");
  std::vector<double> values;
  values.reserve(amount);
  for (std::size_t i = 0; i < amount; ++i)
    values.push_back(binary_ ? double{std::bit_cast<float>(word())} : cursor_.real("a number"));
  if (!binary_ && amount > 0) cursor_.line();
  return values;
}

}  // namespace hiac::formats::ensight
