#include "tools/view/transfer/apply_edit.hpp"

#include "hiac/base/error.hpp"

namespace hiac::view {

bool apply_edit(Document& document, const QString& label, bool merges_with_last,
                const std::function<std::string()>& text) {
  if (!document.has_scene()) return false;
  try {
    return document.edit(label, text(), merges_with_last);
  } catch (const Error& error) {
    Q_EMIT document.message(QString::fromStdString(error.what()));
    return false;
  }
}

}  // namespace hiac::view
