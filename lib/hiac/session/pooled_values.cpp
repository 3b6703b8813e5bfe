#include "hiac/session/pooled_values.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <utility>

#include <fcntl.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/file_descriptor.hpp"

namespace hiac {
namespace {

constexpr const char* kSubject = "values of all steps";
/// The digits of a value's key, the most significant first.
constexpr unsigned kKeyBits = 64, kDigitBits = 16;

/// A number that is ordered as the value is; both zeros have the same.
std::uint64_t key_of(double value) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << (kKeyBits - 1);
  const auto bits = std::bit_cast<std::uint64_t>(value + 0.0);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

double value_of(std::uint64_t key) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << (kKeyBits - 1);
  return std::bit_cast<double>((key & kSign) != 0 ? key & ~kSign : ~key);
}

FileDescriptor open_to_append(const std::string& path) {
  FileDescriptor file(open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  if (file.number() < 0) throw InputError(path, "cannot be written");
  return file;
}

void append(const std::string& path, std::span<const double> values) {
  FileDescriptor file = open_to_append(path);
  write_fully(file.number(),
              {reinterpret_cast<const std::uint8_t*>(values.data()), values.size_bytes()},
              kSubject);
  file.close(kSubject);
}

template <typename Work>
void for_each_value(const std::string& path, const Work& work) {
  const FileDescriptor file = open_to_read(path);
  std::vector<double> part(std::size_t{1} << 16);
  const std::span<std::uint8_t> bytes(reinterpret_cast<std::uint8_t*>(part.data()),
                                      part.size() * sizeof(double));
  for (;;) {
    const std::size_t count = read_fully(file.number(), bytes, kSubject) / sizeof(double);
    for (std::size_t i = 0; i < count; ++i) work(part[i]);
    if (count < part.size()) return;
  }
}

}  // namespace

void PooledValues::add(std::vector<double> values) {
  count_ += values.size();
  const Interval added = extent_of(values);
  extent_ = {std::min(extent_.low, added.low), std::max(extent_.high, added.high)};
  if (extremes_only_) return;
  if (!file_ && values_.size() + values.size() <= most_in_memory_) {
    if (values_.empty())
      values_ = std::move(values);
    else
      values_.insert(values_.end(), values.begin(), values.end());
    return;
  }
  if (!file_) {
    file_ = std::make_unique<TemporaryFile>(temporary_name(), kSubject);
    append(file_->path(), values_);
    values_ = {};
  }
  append(file_->path(), values);
}

// One digit of the value's key after the other: how many values share the digits found so far says
// which digit the rank lies in.
double PooledValues::value_at(std::uint64_t rank) const {
  std::uint64_t prefix = 0;
  for (unsigned found = 0; found < kKeyBits; found += kDigitBits) {
    const unsigned below = kKeyBits - found - kDigitBits;
    std::vector<std::uint64_t> counts(std::size_t{1} << kDigitBits);
    for_each_value(file_->path(), [&](double value) {
      const std::uint64_t digits = key_of(value) >> below;
      if (digits >> kDigitBits == prefix) ++counts[digits & (counts.size() - 1)];
    });
    std::uint64_t digit = 0;
    while (rank >= counts[digit]) rank -= counts[digit++];
    prefix = prefix << kDigitBits | digit;
  }
  return value_of(prefix);
}

double PooledValues::percentile(double percent) {
  if (percent == 0) return extent_.low;
  if (percent == 100) return extent_.high;
  if (!file_) return hiac::percentile(values_, percent);
  const PercentileRank rank = percentile_rank(percent, count_);
  const double below = value_at(rank.below);
  return rank.share == 0 ? below : (1 - rank.share) * below + rank.share * value_at(rank.below + 1);
}

}  // namespace hiac
