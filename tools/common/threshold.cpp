#include "tools/common/threshold.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/special_values.hpp"
#include "hiac/mesh/parts/keep_cells.hpp"
#include "tools/common/number_text.hpp"

namespace hiac::tools {

void add_threshold(CLI::App& app, std::string& request) {
  app.add_option("--threshold", request,
                 "Keep only the cells of which every value of this scalar field lies from LOW to "
                 "HIGH; either may be left out")
      ->type_name("FIELD=LOW,HIGH");
}

bool apply_threshold(Tool& tool, ZooMesh& mesh, const std::string& request) {
  if (request.empty()) return false;
  const std::string option = fmt::format("--threshold {}", request);
  const std::size_t equals = request.rfind('=');
  const std::size_t comma = request.find(',', equals == std::string::npos ? 0 : equals);
  if (equals == std::string::npos || comma == std::string::npos)
    throw UsageError(option + ": FIELD=LOW,HIGH expected (either may be left out)");
  const auto bound = [&](std::string_view text, double none) {
    if (text.empty()) return none;
    const auto number = number_in(text);
    if (!number) throw UsageError(fmt::format("{}: '{}' is no number", option, text));
    return *number;
  };
  const std::string_view text(request);
  const double low = bound(text.substr(equals + 1, comma - equals - 1), -kInfinity);
  const double high = bound(text.substr(comma + 1), kInfinity);
  if (!(low <= high)) throw UsageError(option + ": LOW is above HIGH");
  const std::vector<bool> keep = [&] {
    try {
      return cells_within(mesh, scalar_field(mesh, request.substr(0, equals)), low, high);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("{}: {}", option, error.what()));
    }
  }();
  const auto kept = std::ranges::count(keep, true);
  if (kept == 0) throw InputError(option, "no cell has all of its values within these bounds");
  tool.facts()["threshold"] = {{"kept", kept}, {"cells", keep.size()}};
  tool.note(fmt::format("{}: {} of {} cells are kept", option, kept, keep.size()));
  if (static_cast<std::size_t>(kept) == keep.size()) return false;
  mesh = keep_cells(mesh, keep);
  return true;
}

}  // namespace hiac::tools
