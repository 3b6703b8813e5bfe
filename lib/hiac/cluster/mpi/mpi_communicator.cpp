#include "hiac/cluster/mpi/mpi_communicator.hpp"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <utility>

#include <mpi.h>

namespace hiac {
namespace {

// A message is sent in pieces of this size: MPI counts in int.
constexpr std::uint64_t kPiece = std::uint64_t{1} << 28;

// Calls start(begin, size) for the pieces of a message.
template <typename Start>
void for_each_piece(std::uint64_t size, const Start& start) {
  for (std::uint64_t begin = 0; begin < size; begin += kPiece)
    start(begin, static_cast<int>(std::min(kPiece, size - begin)));
}

}  // namespace

struct MpiCommunicator::State {
  int rank = 0, size = 1;
  std::uint64_t* next = nullptr;  // on rank 0
  MPI_Win window = MPI_WIN_NULL;
  std::mutex taking;
};

MpiCommunicator::MpiCommunicator(int& argc, char**& argv) : state_(std::make_unique<State>()) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &state_->rank);
  MPI_Comm_size(MPI_COMM_WORLD, &state_->size);
  const MPI_Aint bytes = state_->rank == 0 ? sizeof(std::uint64_t) : 0;
  MPI_Win_allocate(bytes, sizeof(std::uint64_t), MPI_INFO_NULL, MPI_COMM_WORLD, &state_->next,
                   &state_->window);
  MPI_Win_lock_all(0, state_->window);
}

MpiCommunicator::~MpiCommunicator() {
  MPI_Win_unlock_all(state_->window);
  MPI_Win_free(&state_->window);
  MPI_Finalize();
}

std::uint32_t MpiCommunicator::rank() const { return static_cast<std::uint32_t>(state_->rank); }
std::uint32_t MpiCommunicator::size() const { return static_cast<std::uint32_t>(state_->size); }

std::vector<Bytes> MpiCommunicator::exchange(std::vector<Bytes> to) {
  const std::size_t ranks = to.size();
  std::vector<std::uint64_t> sent(ranks), coming(ranks);
  for (std::size_t r = 0; r < ranks; ++r) sent[r] = to[r].size();
  MPI_Alltoall(sent.data(), 1, MPI_UINT64_T, coming.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
  std::vector<Bytes> received(ranks);
  std::vector<MPI_Request> requests;
  for (std::uint32_t r = 0; r < ranks; ++r) {
    if (r == rank()) continue;
    received[r].resize(coming[r]);
    for_each_piece(coming[r], [&](std::uint64_t begin, int size) {
      MPI_Irecv(received[r].data() + begin, size, MPI_BYTE, static_cast<int>(r), 0, MPI_COMM_WORLD,
                &requests.emplace_back());
    });
  }
  for (std::uint32_t r = 0; r < ranks; ++r) {
    if (r == rank()) continue;
    for_each_piece(sent[r], [&](std::uint64_t begin, int size) {
      MPI_Isend(to[r].data() + begin, size, MPI_BYTE, static_cast<int>(r), 0, MPI_COMM_WORLD,
                &requests.emplace_back());
    });
  }
  received[rank()] = std::move(to[rank()]);
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return received;
}

void MpiCommunicator::restart_numbers() {
  MPI_Barrier(MPI_COMM_WORLD);
  if (state_->rank == 0) {
    const std::uint64_t zero = 0;
    std::uint64_t old = 0;
    MPI_Fetch_and_op(&zero, &old, MPI_UINT64_T, 0, 0, MPI_REPLACE, state_->window);
    MPI_Win_flush(0, state_->window);
  }
  MPI_Barrier(MPI_COMM_WORLD);
}

std::uint64_t MpiCommunicator::take_number() {
  const std::scoped_lock lock(state_->taking);
  const std::uint64_t one = 1;
  std::uint64_t taken = 0;
  MPI_Fetch_and_op(&one, &taken, MPI_UINT64_T, 0, 0, MPI_SUM, state_->window);
  MPI_Win_flush(0, state_->window);
  return taken;
}

void MpiCommunicator::abort(int exit_code) {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);  // not reached
}

}  // namespace hiac
