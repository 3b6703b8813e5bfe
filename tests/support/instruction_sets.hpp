#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <hwy/targets.h>

namespace hiac::test {

/// Calls f with the name of every instruction set that Highway compiled for and this processor
/// has, kernels being run by it meanwhile.
inline void for_each_instruction_set(const std::function<void(const std::string&)>& f) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    f(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace hiac::test
