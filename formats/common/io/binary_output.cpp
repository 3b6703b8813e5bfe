#include "formats/common/io/binary_output.hpp"

#include <cerrno>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {

BinaryOutput::BinaryOutput(const std::string& path)
    : path_(path), file_(path), stream_(file_.temporary_path(), std::ios::binary) {}

void BinaryOutput::flush() {
  stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
}

void BinaryOutput::finish() {
  flush();
  stream_.close();
  if (!stream_)
    throw InputError(path_, fmt::format("cannot be written ({})", std::strerror(errno)));
  file_.commit();
}

}  // namespace hiac::formats
