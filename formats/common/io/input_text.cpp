#include "formats/common/io/input_text.hpp"

#include <algorithm>
#include <limits>
#include <new>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "hiac/base/error.hpp"
#include "hiac/base/process/page_buffer.hpp"

namespace hiac::formats {
namespace {

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

  /// Unpacks the next bytes into the beginning of `out` and sets how many they are; returns zlib's
  /// status.
  int unpack(std::span<std::uint8_t> out, std::size_t& count) {
    if (stream_.avail_in == 0) {
      constexpr std::size_t kMost = std::numeric_limits<uInt>::max();
      const std::string_view part = rest_.substr(0, kMost);
      // zlib only reads it
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(part.data()));
      stream_.avail_in = static_cast<uInt>(part.size());
      rest_.remove_prefix(part.size());
    }
    const auto space =
        static_cast<uInt>(std::min<std::size_t>(out.size(), std::numeric_limits<uInt>::max()));
    stream_.next_out = out.data();
    stream_.avail_out = space;
    const int status = inflate(&stream_, Z_NO_FLUSH);
    count = space - stream_.avail_out;
    return status;
  }

  [[nodiscard]] bool at_end() const { return stream_.avail_in == 0 && rest_.empty(); }
  /// A gzip file may have several members, one after the other.
  void next_member() { inflateReset(&stream_); }

 private:
  z_stream stream_{};
  std::string_view rest_;
};

/// The bytes of a gzip file. Only what has been unpacked takes memory, once, and no time is spent
/// on copies: where memory is limited (MemoryWatch), it ends at the limit.
SharedArray<std::uint8_t> unpacked(std::string_view packed, const std::string& path) {
  constexpr std::size_t kFirstBytes = std::size_t{1} << 20;
  Inflater inflater(packed);
  const auto buffer = std::make_shared<PageBuffer>();
  std::size_t filled = 0;
  while (true) {
    if (filled == buffer->bytes().size()) buffer->grow(std::max(kFirstBytes, 2 * filled));
    std::size_t count = 0;
    const int status = inflater.unpack(buffer->bytes().subspan(filled), count);
    filled += count;
    if (status == Z_STREAM_END) {
      if (inflater.at_end()) return {buffer->bytes().first(filled), buffer};
      inflater.next_member();
    } else if (status == Z_BUF_ERROR) {
      throw InputError(path,
                       fmt::format("the gzip data end too early (after {} bytes)", packed.size()));
    } else if (status != Z_OK) {
      throw InputError(path,
                       fmt::format("the gzip data are damaged (after {} unpacked bytes)", filled));
    }
  }
}

}  // namespace

InputText::InputText(const std::string& path)
    : path_(path), file_(std::make_unique<MappedFile>(path)), text_(file_->text()) {
  if (is_gzip(text_)) {
    unpacked_ = unpacked(text_, path);
    file_.reset();
    text_ = {reinterpret_cast<const char*>(unpacked_.data()), unpacked_.size()};
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
  std::vector<std::uint8_t> bytes(limit);
  std::size_t filled = 0;
  for (int status = Z_OK; status == Z_OK && filled < limit;) {
    std::size_t count = 0;
    status = inflater.unpack(std::span(bytes).subspan(filled), count);
    filled += count;
  }
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(filled)};
}

}  // namespace hiac::formats
