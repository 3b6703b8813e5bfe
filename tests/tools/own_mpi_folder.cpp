// Open MPI makes and removes one folder for each user and machine. Processes that start while
// others end fail now and then, and tests run beside each other: the programs of each test get a
// folder of its own.
#include <cstdlib>
#include <memory>

#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace hiac {
namespace {

class OwnMpiFolder : public testing::Environment {
 public:
  OwnMpiFolder() { setenv("OMPI_MCA_orte_tmpdir_base", folder_.path().c_str(), 1); }

 private:
  test::ScratchFolder folder_;
};

const testing::Environment* const kAdded =
    testing::AddGlobalTestEnvironment(std::make_unique<OwnMpiFolder>().release());

}  // namespace
}  // namespace hiac
