#pragma once

#include <vector>

#include "hiac/element/field_values.hpp"
#include "hiac/frame/transfer_table.hpp"

namespace hiac {

/// A scalar field and, if a transfer function uses it, the function's interval for each value.
struct FrameField : FieldValues {
  std::vector<ScalarIntervals> intervals;
};

}  // namespace hiac
