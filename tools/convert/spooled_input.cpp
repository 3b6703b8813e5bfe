#include "tools/convert/spooled_input.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "hiac/mesh/file_descriptor.hpp"

namespace hiac::tools {

SpooledInput::SpooledInput(int descriptor, const std::string& subject)
    : subject_(subject),
      file_(temporary_name(), subject, std::filesystem::path(subject).extension().string()) {
  FileDescriptor copy = open_to_write(file_.path());
  std::array<std::uint8_t, 1 << 16> buffer{};
  for (;;) {
    const std::size_t count = read_fully(descriptor, buffer, subject);
    write_fully(copy.number(), std::span(buffer).first(count), file_.path());
    if (count < buffer.size()) break;
  }
  copy.close(file_.path());
}

std::string SpooledInput::told(std::string text) const {
  for (const std::string& name : {path(), std::filesystem::path(path()).filename().string()})
    for (std::size_t at = text.find(name); at != std::string::npos;
         at = text.find(name, at + subject_.size()))
      text.replace(at, name.size(), subject_);
  return text;
}

}  // namespace hiac::tools
