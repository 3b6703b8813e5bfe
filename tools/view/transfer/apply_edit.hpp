#pragma once

#include <QString>
#include <functional>
#include <string>

#include "tools/view/document/document.hpp"

namespace hiac::view {

/// Makes an edit of a document (Document::edit), or tells why there is none. Returns whether there
/// is one.
bool apply_edit(Document& document, const QString& label, bool merges_with_last,
                const std::function<std::string()>& text);

}  // namespace hiac::view
