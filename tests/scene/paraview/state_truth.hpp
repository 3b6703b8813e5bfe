#pragma once

#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace hiac::test {

/// Path of a file of the states that ParaView saved (make_states.py).
inline std::string state_file(const std::string& name) {
  return std::string(HIAC_PARAVIEW_STATES) + "/" + name;
}

/// What ParaView itself computes for a state: the lines of NAME.truth that begin with `word`.
template <std::size_t N>
std::vector<std::array<double, N>> truth(const std::string& name, const std::string& word) {
  std::ifstream file(state_file(name + ".truth"));
  EXPECT_TRUE(file) << name;
  std::vector<std::array<double, N>> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream text(line);
    std::string first;
    text >> first;
    if (first != word) continue;
    for (double& number : rows.emplace_back()) text >> number;
    EXPECT_TRUE(text) << line;
  }
  return rows;
}

}  // namespace hiac::test
