#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// The seam that libFuzzer knows: reads the bytes as a file of the format that the
/// environment variable HIAC_FUZZ_FORMAT names. They
/// must give a valid mesh or an InputError; anything else ends the process.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace hiac::fuzz {

/// Small sound files of the format, to begin from.
std::vector<std::string> seeds();

}  // namespace hiac::fuzz
