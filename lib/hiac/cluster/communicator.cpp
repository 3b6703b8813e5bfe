#include "hiac/cluster/communicator.hpp"

#include <algorithm>
#include <utility>

#include "hiac/cluster/byte_stream.hpp"

namespace hiac {

std::vector<Bytes> all_gather(Communicator& all, const Bytes& own) {
  return all.exchange(std::vector<Bytes>(all.size(), own));
}

std::vector<Bytes> gather(Communicator& all, Bytes own) {
  std::vector<Bytes> to(all.size());
  to[0] = std::move(own);
  std::vector<Bytes> received = all.exchange(std::move(to));
  if (all.rank() != 0) received.clear();
  return received;
}

Bytes broadcast(Communicator& all, const Bytes& own) {
  std::vector<Bytes> to(all.size());
  if (all.rank() == 0) to.assign(all.size(), own);
  return std::move(all.exchange(std::move(to)).front());
}

std::uint64_t most_of_all(Communicator& all, std::uint64_t own) {
  Bytes mine;
  ByteWriter(mine).put(own);
  std::uint64_t most = 0;
  for (const Bytes& received : all_gather(all, mine))
    most = std::max(most, ByteReader(received).get<std::uint64_t>());
  return most;
}

std::vector<std::uint64_t> sum_of_all(Communicator& all, std::span<const std::uint64_t> own) {
  Bytes mine;
  ByteWriter(mine).put_all(own);
  std::vector<std::uint64_t> sum(own.size(), 0);
  for (const Bytes& received : all_gather(all, mine)) {
    const auto counts = ByteReader(received).get_all<std::uint64_t>(own.size());
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += counts[k];
  }
  return sum;
}

}  // namespace hiac
