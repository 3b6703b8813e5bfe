#include "formats/common/io/input_text.hpp"

#include <algorithm>
#include <limits>
#include <new>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

constexpr std::size_t kBufferBytes = 1 << 18;

/// zlib's state, freed whatever happens.
class Inflater {
 public:
  explicit Inflater(std::string_view packed) : rest_(packed) {
    constexpr int kGzip = 16 + MAX_WBITS;
    if (inflateInit2(&stream_, kGzip) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Appends more bytes to `out`; returns zlib's status.
  int unpack(std::string& out) {
    if (stream_.avail_in == 0) {
      constexpr std::size_t kMost = std::numeric_limits<uInt>::max();
      const std::string_view part = rest_.substr(0, kMost);
      // zlib only reads it
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(part.data()));
      stream_.avail_in = static_cast<uInt>(part.size());
      rest_.remove_prefix(part.size());
    }
    stream_.next_out = reinterpret_cast<Bytef*>(buffer_.data());
    stream_.avail_out = static_cast<uInt>(buffer_.size());
    const int status = inflate(&stream_, Z_NO_FLUSH);
    out.append(buffer_.data(), buffer_.size() - stream_.avail_out);
    return status;
  }

  [[nodiscard]] bool at_end() const { return stream_.avail_in == 0 && rest_.empty(); }
  /// A gzip file may have several members, one after the other.
  void next_member() { inflateReset(&stream_); }

 private:
  z_stream stream_{};
  std::string_view rest_;
  std::vector<char> buffer_ = std::vector<char>(kBufferBytes);
};

std::string unpacked(std::string_view packed, const std::string& path) {
  Inflater inflater(packed);
  std::string text;
  while (true) {
    const int status = inflater.unpack(text);
    if (status == Z_STREAM_END) {
      if (inflater.at_end()) return text;
      inflater.next_member();
    } else if (status == Z_BUF_ERROR) {
      throw InputError(path,
                       fmt::format("the gzip data end too early (after {} bytes)", packed.size()));
    } else if (status != Z_OK) {
      throw InputError(
          path, fmt::format("the gzip data are damaged (after {} unpacked bytes)", text.size()));
    }
  }
}

}  // namespace

InputText::InputText(const std::string& path)
    : path_(path), file_(std::make_unique<MappedFile>(path)), text_(file_->text()) {
  if (is_gzip(text_)) {
    unpacked_ = unpacked(text_, path);
    file_.reset();
    text_ = unpacked_;
  }
  text_ = without_byte_order_mark(text_);
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

bool is_gzip(std::string_view head) { return head.starts_with("\x1f\x8b\x08"); }

std::string unpacked_head(std::string_view head, std::size_t limit) {
  Inflater inflater(head);
  std::string text;
  while (text.size() < limit)
    if (inflater.unpack(text) != Z_OK) break;
  text.resize(std::min(text.size(), limit));
  return text;
}

}  // namespace hiac::formats
