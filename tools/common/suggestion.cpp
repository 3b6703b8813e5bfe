#include "tools/common/suggestion.hpp"

#include <algorithm>

namespace hiac::tools {
namespace {

// The optimal string alignment distance: L. Boytsov, "Indexing methods for approximate dictionary
// searching", ACM J. Experimental Algorithmics 16 (2011), section 2.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}  // namespace

std::string likely_meant(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  for (const std::string& candidate : known)
    if (candidate.starts_with(word) && (best.empty() || candidate.size() < best.size()))
      best = candidate;
  if (!best.empty()) return best;
  std::size_t least = word.size() / 3 + 1;
  for (const std::string& candidate : known)
    if (const std::size_t found = distance(word, candidate); found < least) {
      least = found;
      best = candidate;
    }
  return best;
}

}  // namespace hiac::tools
