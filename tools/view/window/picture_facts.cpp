#include "tools/view/window/picture_facts.hpp"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>

namespace hiac::view {
namespace {

QString tr(const char* text) { return QCoreApplication::translate("PictureFacts", text); }

QString pixels_text(const Painted& picture) {
  const auto all = static_cast<qulonglong>(picture.size.width) * picture.size.height;
  if (picture.step > 1)
    return tr("%1 of %2 pixels").arg(static_cast<qulonglong>(picture.pixels)).arg(all);
  QString text = tr("exact: %1 pixels").arg(all);
  if (picture.samples > 1) text += tr(", %1 rays each").arg(picture.samples * picture.samples);
  return text;
}

}  // namespace

QString picture_facts(const Painted& picture, const std::optional<std::optional<double>>& error,
                      double scale) {
  if (!picture.device.empty())
    return tr("hardware preview, single precision%1, by %2 \u00b7 %3 s")
        .arg(picture.wanted->scene.edges ? tr(", without edges") : QString(),
             QString::fromStdString(picture.device))
        .arg(picture.seconds, 0, 'f', 3);
  QStringList parts{tr("accurate engine"), pixels_text(picture)};
  if (picture.step == 1 && error)
    parts << (*error ? tr("error at most %1").arg(**error, 0, 'e', 1)
                     : tr("no error bound claimed"));
  parts << tr("%1 s").arg(picture.seconds, 0, 'f', 3);
  parts << (picture.violations == 0
                ? tr("order verified: 0 segments out of order")
                : tr("%1 segments out of order").arg(static_cast<qulonglong>(picture.violations)));
  if (picture.mean_optical_depth > 0)
    parts << tr("mean optical depth %1").arg(picture.mean_optical_depth, 0, 'g', 3);
  if (scale < 1) parts << tr("shown at %1 %").arg(100 * scale, 0, 'f', 0);
  return parts.join(QStringLiteral(" \u00b7 "));
}

}  // namespace hiac::view
