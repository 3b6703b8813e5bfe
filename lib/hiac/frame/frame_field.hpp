#pragma once

#include <vector>

#include "hiac/element/field_values.hpp"
#include "hiac/frame/transfer_table.hpp"

namespace hiac {

/// A scalar field and, where a transfer function reads it, the function's interval of each value.
struct FrameField : FieldValues {
  std::vector<ScalarIntervals> intervals;
};

}  // namespace hiac
