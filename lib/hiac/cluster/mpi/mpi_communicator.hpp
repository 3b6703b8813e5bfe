#pragma once

#include <memory>
#include <vector>

#include "hiac/cluster/communicator.hpp"

namespace hiac {

/// All processes of an MPI run (MPI_COMM_WORLD). One object a program; MPI begins and ends with it.
/// Errors of MPI itself end all processes.
class MpiCommunicator final : public Communicator {
 public:
  MpiCommunicator(int& argc, char**& argv);
  ~MpiCommunicator() override;

  [[nodiscard]] std::uint32_t rank() const override;
  [[nodiscard]] std::uint32_t size() const override;
  std::vector<Bytes> exchange(std::vector<Bytes> to) override;
  void restart_numbers() override;
  std::uint64_t take_number() override;

  /// Ends all processes, wherever they are, with this exit code.
  [[noreturn]] static void abort(int exit_code);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hiac
