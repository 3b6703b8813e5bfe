#include "hiac/session/pooled_values.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include <fcntl.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/file_descriptor.hpp"
#include "hiac/session/value_key.hpp"

namespace hiac {
namespace {

constexpr const char* kSubject = "values of all steps";
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

double PooledValues::value_at(std::uint64_t rank) const {
  RankedKey ranked(rank);
  while (!ranked.found()) {
    std::vector<std::uint64_t> counts(RankedKey::kDigits);
    for_each_value(file_->path(), [&](double value) { ranked.count(key_of(value), counts); });
    ranked.take(counts);
  }
  return value_of(ranked.key());
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
