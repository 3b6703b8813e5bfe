#include "tests/cluster/parts_of.hpp"

#include <algorithm>
#include <atomic>
#include <barrier>
#include <cstring>
#include <thread>
#include <utility>

#include "hiac/mesh/parts/keep_cells.hpp"
#include "hiac/mesh/parts/used_nodes.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac::test {
namespace {

// What the threads that play the ranks share.
struct Hall {
  explicit Hall(std::uint32_t ranks) : meeting(ranks), boxes(ranks) {}

  std::barrier<> meeting;
  std::vector<std::vector<Bytes>> boxes;  // of each sender, what each receiver gets
  std::atomic<std::uint64_t> next = 0;
};

class ThreadCommunicator final : public Communicator {
 public:
  ThreadCommunicator(Hall& hall, std::uint32_t rank) : hall_(hall), rank_(rank) {}

  [[nodiscard]] std::uint32_t rank() const override { return rank_; }
  [[nodiscard]] std::uint32_t size() const override {
    return static_cast<std::uint32_t>(hall_.boxes.size());
  }
  std::vector<Bytes> exchange(std::vector<Bytes> to) override {
    hall_.boxes[rank_] = std::move(to);
    hall_.meeting.arrive_and_wait();
    std::vector<Bytes> received;
    for (std::vector<Bytes>& box : hall_.boxes) received.push_back(std::move(box[rank_]));
    hall_.meeting.arrive_and_wait();
    return received;
  }
  void restart_numbers() override {
    hall_.meeting.arrive_and_wait();
    hall_.next = 0;
    hall_.meeting.arrive_and_wait();
  }
  std::uint64_t take_number() override { return hall_.next++; }

 private:
  Hall& hall_;
  std::uint32_t rank_;
};

}  // namespace

Parts::Parts(const ZooMesh& mesh, std::span<const std::uint32_t> part_of_cell, std::uint32_t count,
             const Scene& scene) {
  for (std::uint32_t number = 0; number < count; ++number) {
    std::vector<bool> keep(mesh.cell_count());
    std::vector<NodeId> nodes;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
      keep[cell] = part_of_cell[cell] == number;
      if (keep[cell]) std::ranges::copy(mesh.cell_nodes(cell), std::back_inserter(nodes));
    }
    if (nodes.empty()) continue;
    Part part{number, keep_cells(mesh, keep), {}, {}};
    const auto used = mark_used_nodes(nodes, mesh.node_count());
    for (std::uint64_t node = 0; node < used.size(); ++node)
      if (used[node] != 0) part.global_nodes.push_back(node);
    part.order = sorted(part.mesh, scene);
    parts_.push_back(std::move(part));
  }
}

std::vector<DrawnPart> Parts::of_rank(std::uint32_t rank, std::uint32_t ranks,
                                      bool reversed) const {
  std::vector<DrawnPart> own;
  for (const Part& part : parts_)
    if (part.number % ranks == rank)
      own.push_back({part.number, part.mesh, part.global_nodes, part.order});
  if (!reversed) return own;
  std::vector<DrawnPart> other;
  for (auto part = own.rbegin(); part != own.rend(); ++part) other.push_back(*part);
  return other;
}

void run_ranks(std::uint32_t ranks, const std::function<void(Communicator&)>& work) {
  Hall hall(ranks);
  std::vector<std::jthread> threads;
  for (std::uint32_t rank = 0; rank < ranks; ++rank)
    threads.emplace_back([&, rank] {
      ThreadCommunicator communicator(hall, rank);
      work(communicator);
    });
}

bool same_bits(const Image& a, const Image& b) {
  return a.values().size() == b.values().size() &&
         std::memcmp(a.values().data(), b.values().data(), a.values().size_bytes()) == 0;
}

}  // namespace hiac::test
