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
/// No file has more parts: a larger number indicates the other byte order.
constexpr std::int64_t kMostParts = 65'535;

std::size_t mark_at(std::string_view all, std::size_t at, bool swap) {
  std::uint32_t mark = 0;
  std::memcpy(&mark, all.data() + at, sizeof mark);
  return swap ? __builtin_bswap32(mark) : mark;
}

/// Every record is preceded and followed by its length.
std::string without_marks(const InputText& input, bool swap) {
  constexpr std::size_t kMark = 4;
  const std::string_view all = input.text();
  std::string bytes;
  bytes.reserve(all.size());
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t left = all.size() - at;
    const std::size_t length = left < 2 * kMark ? left : mark_at(all, at, swap);
    if (length > left - 2 * kMark || left < 2 * kMark ||
        mark_at(all, at + kMark + length, swap) != length)
      throw InputError(fmt::format("{}: byte {}", input.path(), at),
                       "a record between two marks of its length expected");
    bytes.append(all.substr(at + kMark, length));
    at += length + 2 * kMark;
  }
  return bytes;
}

}  // namespace

GoldFile::GoldFile(const std::string& path, const Encoding& encoding)
    : input_(std::make_shared<InputText>(path)),
      unmarked_(encoding.marked
                    ? std::make_shared<const std::string>(without_marks(*input_, encoding.swap))
                    : nullptr),
      cursor_(unmarked_ ? std::string_view(*unmarked_) : input_->text(), path),
      encoding_(encoding),
      order_known_(true) {}

GoldFile GoldFile::open_geometry(const std::string& path) {
  Encoding encoding;
  {
    const InputText input(path);
    const std::string_view all = input.text();
    encoding.binary = all.starts_with("C Binary");
    constexpr std::size_t kMark = 4;
    if (all.size() > kTextBytes && all.substr(kMark).starts_with("Fortran Binary")) {
      encoding.binary = encoding.marked = true;
      encoding.swap = mark_at(all, 0, false) != kTextBytes;
    }
  }
  GoldFile file(path, encoding);
  file.order_known_ = !encoding.binary || encoding.marked;
  if (encoding.binary) file.text();
  return file;
}

void GoldFile::select_step(std::size_t step) {
  constexpr std::string_view kBegin = "BEGIN TIME STEP";
  const std::string_view all = cursor_.text();
  std::size_t at = cursor_.offset();
  for (std::size_t i = 0; i <= step; ++i) {
    const std::size_t found = all.find(kBegin, i == 0 ? at : at + kBegin.size());
    if (found == std::string_view::npos && i == 0) return;
    if (found == std::string_view::npos)
      throw InputError(cursor_.subject(),
                       fmt::format("holds {} steps ({} expected at least)", i, step + 1));
    at = found;
  }
  cursor_.move_to(at);
  text();
}

void GoldFile::fail(const std::string& problem, std::size_t place) const {
  if (encoding_.binary)
    throw InputError(fmt::format("{}: byte {}", cursor_.subject(), cursor_.offset()), problem);
  TextCursor look = cursor_;
  look.move_to(last_);
  for (; place > 0; --place) look.word();
  look.skip_space();
  look.fail(problem);
}

bool GoldFile::at_end() {
  if (!encoding_.binary) cursor_.skip_space();
  constexpr std::string_view kEnd = "END TIME STEP";
  return cursor_.at_end() || cursor_.text().substr(cursor_.offset()).starts_with(kEnd);
}

std::string GoldFile::text(bool peek) {
  const std::size_t before = last_ = cursor_.offset();
  std::string result;
  if (encoding_.binary) {
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
  return encoding_.swap ? __builtin_bswap32(value) : value;
}

std::int64_t GoldFile::whole() { return wholes(1).front(); }

std::size_t GoldFile::count(std::size_t bytes_each) {
  const std::int64_t value = whole();
  const std::size_t most = cursor_.left() / (encoding_.binary ? bytes_each : 2);
  if (value < 0 || static_cast<std::uint64_t>(value) > most)
    fail(fmt::format("a count that fits the file expected (at most {}; {} found)", most, value));
  return static_cast<std::size_t>(value);
}

std::int64_t GoldFile::part_number() {
  const std::size_t before = cursor_.offset();
  std::int64_t value = whole();
  if (!order_known_ && (value < 1 || value > kMostParts)) {
    encoding_.swap = !encoding_.swap;
    cursor_.move_to(before);
    value = whole();
  }
  order_known_ = true;
  if (value < 1 || value > kMostParts)
    fail(fmt::format("the number of a part expected ({} found)", value));
  return value;
}

std::vector<std::int64_t> GoldFile::wholes(std::size_t amount) {
  last_ = cursor_.offset();
  if (amount > cursor_.left() / (encoding_.binary ? 4 : 1)) fail("ended in a list of numbers");
  std::vector<std::int64_t> values;
  values.reserve(amount);
  for (std::size_t i = 0; i < amount; ++i)
    values.push_back(encoding_.binary ? std::bit_cast<std::int32_t>(word())
                                      : cursor_.integer("a whole number"));
  if (!encoding_.binary && amount > 0) cursor_.line();
  return values;
}

std::vector<double> GoldFile::reals(std::size_t amount) {
  last_ = cursor_.offset();
  if (amount > cursor_.left() / (encoding_.binary ? 4 : 1)) fail("ended in a list of numbers");
  std::vector<double> values;
  values.reserve(amount);
  for (std::size_t i = 0; i < amount; ++i)
    values.push_back(encoding_.binary ? double{std::bit_cast<float>(word())}
                                      : cursor_.real("a number"));
  if (!encoding_.binary && amount > 0) cursor_.line();
  return values;
}

}  // namespace hiac::formats::ensight
