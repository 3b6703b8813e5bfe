#include "hiac/base/cancellation.hpp"

#include <utility>

namespace hiac {
namespace {

thread_local const Cancellation* current = nullptr;

}  // namespace

const Cancellation* current_cancellation() { return current; }

CancellationScope::CancellationScope(const Cancellation* cancellation)
    : before_(std::exchange(current, cancellation)) {}

CancellationScope::~CancellationScope() { current = before_; }

void check_cancelled() {
  if (current != nullptr && current->requested()) throw Cancelled();
}

}  // namespace hiac
