#pragma once

#include <string>

namespace hiac::tools {

/// A text of lines as it may be printed on a terminal: control characters other than line ends and
/// tabs, which files can hold, become blanks; so do the control characters of Unicode from U+0080
/// to U+009F.
std::string plain_text(std::string text);

/// The same without line ends and tabs: a message is one line whatever a library put into it.
std::string plain_line(std::string text);

}  // namespace hiac::tools
