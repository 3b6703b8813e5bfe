#pragma once

#include <string>
#include <vector>

#include "tests/formats/files.hpp"

namespace hiac::formats {

/// A file, and all that the refusal says behind the file's path; empty: the file is read.
struct Complaint {
  std::string text;
  std::string message;
};

/// That files of that name with those texts are refused so, word by word, or read.
inline void expect_complaints(const std::string& name, const std::vector<Complaint>& rows) {
  const ScratchFolder folder;
  for (const auto& [text, message] : rows) {
    const std::string path = folder.write(name, text);
    EXPECT_EQ(refusal(path), message.empty() ? "" : path + message) << text;
  }
}

}  // namespace hiac::formats
