#pragma once

#include <span>

#include "hiac/scene/scene.hpp"
#include "hiac/scene/toml/spec_key.hpp"
#include "hiac/scene/transfer_range.hpp"

namespace hiac {

/// The table [volume.extinction] before its range is resolved.
struct ExtinctionSource {
  ExtinctionTransfer transfer;
  TransferRange range;
};

std::span<const SpecKey<ExtinctionSource>> extinction_keys();

/// Reads the table. Points that have to wait for the field's values go into the context.
ExtinctionTransfer read_extinction_transfer(const SpecValue& table);

}  // namespace hiac
