// In place of lib/hiac/base/isolated_process.cpp: libFuzzer sees what happens in its own
// process alone.
#include "hiac/base/process/isolated_process.hpp"

namespace hiac {

struct IsolatedProcess::Link {};

IsolatedProcess::IsolatedProcess(std::string library, Serve serve)
    : library_(std::move(library)),
      serve_(std::move(serve)),
      memory_(std::make_shared<SharedMemory>()) {}

IsolatedProcess::~IsolatedProcess() = default;

PackedAnswer IsolatedProcess::answer(const std::string& path, const std::string& request) {
  const std::size_t begin = (memory_->size() + kPackPage - 1) / kPackPage * kPackPage;
  PackWriter out(memory_->descriptor(), begin);
  serve_(path, request, out);
  return PackedAnswer(memory_, begin, out.end());
}

}  // namespace hiac
