// What libFuzzer calls before it begins: its corpus folders get the seeds.
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "tests/fuzz/seeds.hpp"
#include "tests/fuzz/target.hpp"

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  for (int a = 1; a < *argc; ++a) {
    const std::string folder = (*argv)[a];
    if (folder.starts_with("-") || !std::filesystem::is_directory(folder)) continue;
    std::size_t number = 0;
    for (const std::string& seed : hiac::fuzz::seeds(hiac::fuzz::target().name))
      std::ofstream(folder + "/seed-" + std::to_string(number++), std::ios::binary) << seed;
  }
  return 0;
}
