#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hiac {

using Bytes = std::vector<std::byte>;

/// Processes, or what stands for them, that do the same and exchange bytes. All functions but
/// `take_number` are called by all of them in the same order, in each by one thread at a time.
class Communicator {
 public:
  Communicator() = default;
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  virtual ~Communicator() = default;

  /// The number of this process, below that of all.
  [[nodiscard]] virtual std::uint32_t rank() const = 0;
  [[nodiscard]] virtual std::uint32_t size() const = 0;

  /// Sends `to[r]` to every rank r, and returns what every rank sends to this one. Returns after
  /// all have called it.
  virtual std::vector<Bytes> exchange(std::vector<Bytes> to) = 0;

  /// Numbers are handed out from 0 on again. All processes must have taken theirs.
  virtual void restart_numbers() = 0;
  /// The next number that no process has taken yet. May be called by any thread at any time.
  virtual std::uint64_t take_number() = 0;
};

/// What every rank gives, for every rank.
std::vector<Bytes> all_gather(Communicator& all, const Bytes& own);
/// What every rank gives, for rank 0; empty on others.
std::vector<Bytes> gather(Communicator& all, Bytes own);
/// What rank 0 gives.
Bytes broadcast(Communicator& all, const Bytes& own);

/// The largest number that any rank gives.
std::uint64_t most_of_all(Communicator& all, std::uint64_t own);
/// The sums of what all ranks give, number by number.
std::vector<std::uint64_t> sum_of_all(Communicator& all, std::span<const std::uint64_t> own);

}  // namespace hiac
