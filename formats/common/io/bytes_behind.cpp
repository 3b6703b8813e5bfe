#include "formats/common/io/bytes_behind.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

namespace hiac::formats {
namespace {

constexpr std::string_view kHdf5{"\x89HDF\r\n\x1a\n", 8};

std::uint64_t little_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i > 0; --i)
    value = value << 8U | static_cast<unsigned char>(bytes[i - 1]);
  return value;
}

/// The end-of-file address in the superblock ("HDF5 File Format Specification", II.A). Addresses of
/// other sizes than 8 bytes are written by no known program.
std::optional<std::uint64_t> hdf5_end(std::string_view head) {
  constexpr std::size_t kAddress = 8;
  const auto version = static_cast<unsigned char>(head[8]);
  const bool old = version < 2;
  if (version > 3 || head[old ? 13 : 9] != kAddress) return std::nullopt;
  // behind the base address and another one; version 1 has four bytes more than version 0
  const std::size_t at = old ? 40 + 4 * std::size_t{version} : 28;
  return little_endian(head.substr(at, kAddress));
}

/// The end of an ADF file: a block of 4096 bytes and an offset in it, in hexadecimal digits, behind
/// those of the root node. Files are filled up to whole blocks.
std::optional<std::uint64_t> adf_end(std::string_view head) {
  constexpr std::size_t kBlockAt = 0x92, kBlockDigits = 8;
  constexpr std::uint64_t kBlockBytes = 4096;
  std::uint64_t block = 0;
  const char* begin = head.data() + kBlockAt;
  const auto [end, error] = std::from_chars(begin, begin + kBlockDigits, block, 16);
  if (error != std::errc() || end != begin + kBlockDigits) return std::nullopt;
  return (block + 1) * kBlockBytes;
}

}  // namespace

void note_bytes_behind(std::uint64_t bytes, std::string_view what,
                       std::vector<std::string>& notes) {
  if (bytes > 0)
    notes.push_back(fmt::format("{} bytes behind the end of {} are not read", bytes, what));
}

void note_text_behind(std::string_view rest, std::string_view what,
                      std::vector<std::string>& notes) {
  constexpr std::string_view kBlank{" \t\r\n\v\f\0", 7};
  const std::size_t last = rest.find_last_not_of(kBlank);
  if (last == std::string_view::npos) return;
  const std::size_t first = rest.find_first_not_of(kBlank);
  note_bytes_behind(last + 1 - first, what, notes);
}

void note_behind_root(std::string_view xml, std::string_view root,
                      std::vector<std::string>& notes) {
  const std::size_t tag = xml.rfind(fmt::format("</{}", root));
  const std::size_t end = tag == std::string_view::npos ? tag : xml.find('>', tag);
  if (end != std::string_view::npos)
    note_text_behind(xml.substr(end + 1), fmt::format("</{}>", root), notes);
}

std::optional<std::uint64_t> container_end(std::string_view head) {
  if (head.size() < kContainerHead) return std::nullopt;
  if (head.starts_with(kHdf5)) return hdf5_end(head);
  if (head.substr(4).starts_with("ADF Database Version")) return adf_end(head);
  return std::nullopt;
}

void note_bytes_behind_container(const std::string& path, std::vector<std::string>& notes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return;
  std::array<char, kContainerHead> head{};
  std::ifstream file(path, std::ios::binary);
  if (!file.read(head.data(), head.size())) return;
  const auto end = container_end({head.data(), head.size()});
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (end && !error && size > *end)
    note_bytes_behind(size - *end, head[1] == 'H' ? "the HDF5 container" : "the ADF container",
                      notes);
}

}  // namespace hiac::formats
