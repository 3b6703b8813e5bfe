#include "hiac/base/cancellation.hpp"

#include <utility>

namespace hiac {
namespace {

thread_local const Cancellation* set_for_thread = nullptr;

}  // namespace

const Cancellation* current_cancellation() { return set_for_thread; }

CancellationScope::CancellationScope(const Cancellation* cancellation)
    : before_(std::exchange(set_for_thread, cancellation)) {}

CancellationScope::~CancellationScope() { set_for_thread = before_; }

void check_cancelled() {
  if (set_for_thread != nullptr && set_for_thread->requested()) throw Cancelled();
}

}  // namespace hiac
