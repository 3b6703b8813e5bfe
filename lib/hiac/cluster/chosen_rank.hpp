#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hiac {

/// The process that compares what several parts tell under one key, such as the numbers of a face's
/// nodes. Keys are spread evenly over the processes.
template <std::size_t N>
std::uint32_t chosen_rank(const std::array<std::uint64_t, N>& key, std::uint32_t ranks) {
  std::uint64_t hash = 0;
  for (const std::uint64_t number : key) {
    // the finalizer of SplitMix64 (Steele, Lea, Flood 2014)
    std::uint64_t mixed = hash ^ (number + 0x9e3779b97f4a7c15ULL);
    mixed = (mixed ^ mixed >> 30U) * 0xbf58476d1ce4e5b9ULL;
    mixed = (mixed ^ mixed >> 27U) * 0x94d049bb133111ebULL;
    hash = mixed ^ mixed >> 31U;
  }
  return static_cast<std::uint32_t>(hash % ranks);
}

}  // namespace hiac
