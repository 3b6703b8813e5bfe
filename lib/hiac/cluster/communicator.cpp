#include "hiac/cluster/communicator.hpp"

#include <utility>

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

}  // namespace hiac
