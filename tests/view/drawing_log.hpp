#pragma once

#include <QObject>
#include <QStringList>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hiac/session/session.hpp"
#include "tests/support/meshes.hpp"
#include "tests/view/open_window.hpp"
#include "tools/view/viewport/drawing.hpp"

namespace hiac::view::test {

/// A structured mesh of [0, 1]^3 with a smooth field, and its starter view without edges.
inline Wanted wanted_of(std::size_t cells_along, ImageSize size,
                        hiac::test::Cut cut = hiac::test::Cut::tetrahedra) {
  ZooMesh mesh = hiac::test::structured(cells_along, cut);
  hiac::test::add_node_field(mesh, "f", hiac::test::smooth_field);
  Scene scene = starter_view(mesh);
  scene.image = size;
  scene.edges.reset();  // coarse pixels have means of lines, and previews draw none
  return {std::make_shared<const ZooMesh>(std::move(mesh)), scene, {}, 1};
}

/// What a drawing reports, in order.
class DrawingLog {
 public:
  explicit DrawingLog(Drawing& drawing) {
    QObject::connect(&drawing, &Drawing::painted, &here_,
                     [this](const std::shared_ptr<const Painted>& p) { painted.push_back(p); });
    QObject::connect(&drawing, &Drawing::bounded, &here_,
                     [this](quint64, const std::optional<double>& e) { errors.push_back(e); });
    QObject::connect(&drawing, &Drawing::failed, &here_,
                     [this](const QString& line, bool) { faults << line; });
    QObject::connect(&drawing, &Drawing::rested, &here_, [this](quint64 n) { rested = n; });
  }

  bool rests(std::uint64_t number) {
    return wait_until([&] { return rested == number; });
  }

  std::vector<std::shared_ptr<const Painted>> painted;
  std::vector<std::optional<double>> errors;
  QStringList faults;
  quint64 rested = 0;

 private:
  QObject here_;
};

}  // namespace hiac::view::test
