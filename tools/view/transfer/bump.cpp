#include "tools/view/transfer/bump.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/toml/edited_text.hpp"
#include "hiac/scene/toml/spec_key.hpp"
#include "hiac/session/field_values.hpp"
#include "hiac/session/starter/starter_camera.hpp"
#include "tools/view/transfer/apply_edit.hpp"
#include "tools/view/transfer/transfer_text.hpp"

namespace hiac::view {
namespace {

/// The extinction with which a ray through the middle of the mesh's box loses most of its light.
double usual_extinction(const ZooMesh& mesh) {
  std::array<double, 3> low = {0, 0, 0}, high = {0, 0, 0};
  for (std::size_t i = 0; i < mesh.xyz.size(); ++i) {
    low[i % 3] = i < 3 ? mesh.xyz[i] : std::min(low[i % 3], mesh.xyz[i]);
    high[i % 3] = i < 3 ? mesh.xyz[i] : std::max(high[i % 3], mesh.xyz[i]);
  }
  const double size = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  return size > 0 ? starter::rounded(20 / size, 20 / size) : 1;
}

std::string bumped(const Document& document, double value) {
  if (!document.mesh()) throw UsageError("a bump: there is no mesh");
  const Scene& scene = document.scene();
  const Volume& volume = scene.volume;
  if (!volume.extinction && !volume.color)
    throw UsageError(
        "a bump: the view names no field (expected [volume.color] or "
        "[volume.extinction])");
  const std::string field = volume.extinction ? volume.extinction->field : volume.color->field;
  const auto [low, high] = field_extent(document, field);
  const double whole = low < high ? high - low : std::max(std::abs(value), 1.0);
  const double width = starter::rounded(whole / 40, whole);
  const double at = starter::rounded(value, whole);
  const double usual = usual_extinction(*document.mesh());
  if (volume.extinction)
    return with_bump(document.text(), scene, at, width,
                     bump_peak(volume.extinction->points, usual));
  const std::array<ExtinctionTransfer::Point, 3> points{
      {{at - width, {0}}, {at, {usual}}, {at + width, {0}}}};
  std::string rows;
  for (const auto& [scalar, extinction] : points)
    rows += fmt::format("\n  [{}, {}],", toml_text(scalar), toml_text(extinction[0]));
  const std::vector<std::pair<std::string, std::string>> keys{
      {"field", toml_text(field)}, {"points", fmt::format("[{}\n]", rows)}};
  return with_table(document.text(), "volume.extinction", keys);
}

}  // namespace

void add_bump(Document& document, double value) {
  apply_edit(document, Document::tr("bump"), false, [&] { return bumped(document, value); });
}

std::array<double, 2> field_extent(const Document& document, const std::string& field) {
  const ZooMesh& mesh = *document.mesh();
  const Interval extent = extent_of(values_in_cells(mesh, scalar_field(mesh, field)));
  if (extent.empty()) return {0, 0};
  return {extent.low, extent.high};
}

}  // namespace hiac::view
