#pragma once

#include <cctype>
#include <string>

namespace hiac::formats {

/// Text from a file in a form that fits a message of one line.
inline std::string printable(std::string text) {
  for (char& c : text)
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0) c = ' ';
  return text;
}

}  // namespace hiac::formats
