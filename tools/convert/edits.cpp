#include "tools/convert/edits.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/check/cells.hpp"
#include "hiac/derive/deform.hpp"
#include "hiac/derive/derive_field.hpp"
#include "hiac/mesh/fields/find_field.hpp"
#include "tools/common/as_option.hpp"
#include "tools/common/number_text.hpp"
#include "tools/common/threshold.hpp"
#include "tools/convert/tell.hpp"

namespace hiac::tools {
namespace {

void derive(Tool& tool, ZooMesh& mesh, const std::string& formula) {
  Field field = as_option("--", [&] { return derive_field(mesh, formula); });
  const auto odd = std::ranges::count_if(field.values.view(),
                                         [](double value) { return !std::isfinite(value); });
  if (odd > 0)
    tell(tool, fmt::format("--derive {}: {} of {} values are not finite", formula, odd,
                           field.values.size()));
  mesh.fields.push_back(std::move(field));
}

// Names the cells that the new positions turn inside out.
void tell_inverted(Tool& tool, const ZooMesh& mesh, const std::string& option) {
  const CellShapes shapes = judge_cells(mesh, 0);
  std::size_t count = 0, first = 0;
  for (std::size_t cell = shapes.turns.size(); cell-- > 0;) {
    if (shapes.turns[cell] == shapes.hand || shapes.turns[cell] == Turn::undecided) continue;
    ++count;
    first = cell;
  }
  tool.facts()["warp"]["inverted_cells"] = count;
  if (count > 0)
    tell(tool, fmt::format("{}: {} cells of the deformed mesh are flat or inside out, wholly or in "
                           "part (the first is cell {})",
                           option, count, first));
}

void warp(Tool& tool, ZooMesh& mesh, const std::string& request) {
  const std::string option = fmt::format("--warp {}", request);
  // the whole name first: names may hold colons
  const auto field_named = [&](std::string_view name) {
    return as_option(option + ": ", [&] { return find_field(mesh, name); });
  };
  const Field* field = field_named(request);
  double scale = 1;
  if (const std::size_t colon = request.rfind(':');
      field == nullptr && colon != std::string::npos) {
    const auto number = number_in(std::string_view(request).substr(colon + 1));
    if (!number) throw UsageError(option + ": FIELD or FIELD:SCALE expected");
    scale = *number;
    field = field_named(std::string_view(request).substr(0, colon));
  }
  if (field == nullptr) throw UsageError(option + ": there is no such field");
  const Field displacement = *field;
  as_option(option + ": ", [&] { deform(mesh, displacement, scale); });
  tool.facts()["warp"] = {{"field", displacement.name}, {"scale", scale}};
  tell_inverted(tool, mesh, option);
}

}  // namespace

void Edits::add_options(CLI::App& app) {
  app.add_option("--derive", derivations,
                 "Add a field computed from others: 'speed = magnitude(v)', 'q = 2*p + x^2', "
                 "'s = von_mises(stress)', 'v = vector(u, v, w)'; repeatable")
      ->type_name("NAME=EXPRESSION")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--warp", warp,
                 "Move every node by SCALE (default: 1) times this field, a displacement")
      ->type_name("FIELD[:SCALE]");
  add_threshold(app, threshold);
}

void edit(Tool& tool, ZooMesh& mesh, const Edits& edits) {
  for (const std::string& formula : edits.derivations) derive(tool, mesh, formula);
  if (!edits.warp.empty()) warp(tool, mesh, edits.warp);
  apply_threshold(tool, mesh, edits.threshold);
}

}  // namespace hiac::tools
