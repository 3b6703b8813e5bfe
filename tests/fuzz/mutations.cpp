// What runs a target where there is no libFuzzer: every truncation of every seed, telling values at
// every byte, and random changes from a fixed seed. Usage: HIAC_FUZZ_FORMAT=NAME fuzz_formats
// [RANDOM_CHANGES].
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>

#include "tests/fuzz/seeds.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/instrumented.hpp"

namespace {

void run(const std::string& input) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

/// What changes a file that is refused anyway tries little.
bool is_sound(const std::string& seed) {
  try {
    hiac::fuzz::read_input(seed);
    return true;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "a seed is refused: %s\n", error.what());
    return false;
  }
}

/// Words and bytes that have a meaning in one of the formats.
const std::vector<std::string> kTelling{"0",
                                        "-1",
                                        "9999999999",
                                        "1e400",
                                        "nan",
                                        "-",
                                        "",
                                        "\n",
                                        ",",
                                        "*",
                                        "99999999999999999999",
                                        "$",
                                        "\xff",
                                        "(",
                                        "=",
                                        "\"",
                                        "+5",
                                        "1.5",
                                        std::string(4, '\0'),
                                        std::string("\xff\xff\xff\x7f", 4)};

std::string changed(const std::string& seed, std::mt19937& random) {
  std::string text = seed;
  for (std::size_t change = random() % 4 + 1; change > 0 && !text.empty(); --change) {
    const std::size_t at = random() % text.size();
    const std::size_t length = random() % 8;
    switch (random() % 4) {
      case 0:
        text.replace(at, length, kTelling[random() % kTelling.size()]);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(random() % text.size(), random() % 60));
        break;
      default:
        text[at] = static_cast<char>(random() % 256);
    }
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  const long rounds = argc > 1 ? std::atol(argv[1]) : static_cast<long>(hiac::test::tried(100));
  const std::vector<std::string> seeds = hiac::fuzz::seeds(hiac::fuzz::target().name);
  std::size_t runs = 0;
  std::mt19937 random(20261121);
  for (const std::string& seed : seeds) {
    if (!is_sound(seed)) return 1;
    // long seeds are cut and changed at some of their bytes, all of a short one's
    const std::size_t stride = 1 + seed.size() / hiac::test::tried(400);
    for (std::size_t at = 0; at < seed.size(); at += stride, runs += 3) {
      run(seed.substr(0, at));
      std::string text = seed;
      text[at] = static_cast<char>('0' + at % 10);
      run(text);
      text[at] = at % 3 == 0 ? '-' : (at % 3 == 1 ? ' ' : '\n');
      run(text);
    }
    for (long round = 0; round < rounds; ++round, ++runs) run(changed(seed, random));
  }
  std::printf("%zu inputs\n", runs);
  return runs > 0 ? 0 : 1;
}
