#pragma once

#include <string>
#include <vector>

namespace hiac::formats::exodus {

/// The files of a parallel run whose piece `path` is by its name, NAME.N.K: piece K of N, K from 0
/// with as many digits as N. In the order of K; only `path` if it has another name. Throws
/// InputError when a piece is missing.
///
/// SEACAS: the applications nem_spread and epu; Nemesis I user's guide.
std::vector<std::string> run_pieces(const std::string& path);

}  // namespace hiac::formats::exodus
