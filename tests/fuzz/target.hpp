#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// The seam that libFuzzer knows: reads the bytes with the reader that the environment variable
/// HIAC_FUZZ_FORMAT names. They must give something valid or an InputError of one line; anything
/// else ends the process.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace hiac::fuzz {

/// A reader, and how its files are called.
struct Target {
  std::string name;
  std::string extension;
  std::function<void(const std::string& path)> read;  ///< throws InputError
};

/// The formats that are registered, and what reads files besides: "points" (.csv), "poly",
/// "vtu-surface", "classic-netcdf"; under CTest those of other_targets.hpp. Throws UsageError for
/// another name.
Target target_named(const std::string& name);

/// The target that HIAC_FUZZ_FORMAT names.
const Target& target();

/// Reads the input with the target; throws what that throws.
void read_input(std::string_view input);

}  // namespace hiac::fuzz
