#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "hiac/cluster/communicator.hpp"

namespace hiac::tools {

/// What a process tells of a picture that it has made alone.
struct ShotReport {
  std::size_t shot;
  nlohmann::ordered_json facts;
  std::vector<std::string> warnings;
  bool is_own;  ///< made by the process that has the report, which has told the warnings
};

/// How many of `count` pictures of one mesh all processes make together. Of the others each makes
/// as many alone. These come last: a process that made none of them would have nothing yet that all
/// orders have in common, which those who share an order make together. Null: one process.
std::size_t shared_shots(const Communicator* all, std::size_t count);

/// Hands out pictures to processes, each to one of them as soon as it has made its last one. All
/// processes call it. `draw` makes a picture and reports on it. Returns the reports in the order of
/// the pictures in rank 0, none in others.
std::vector<ShotReport> share_shots(Communicator& all, std::size_t count,
                                    const std::function<ShotReport(std::size_t shot)>& draw);

}  // namespace hiac::tools
