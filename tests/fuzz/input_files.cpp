#include "tests/fuzz/input_files.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <utility>

#include <unistd.h>

namespace hiac::fuzz {
namespace {

constexpr std::string_view kParting = "\n==== ";
constexpr std::size_t kLongestName = 80;

bool is_plain(std::string_view name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '/' || c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= kLongestName && name.front() != '/' &&
         name.back() != '/' && name.find("..") == std::string_view::npos &&
         std::all_of(name.begin(), name.end(), plain);
}

}  // namespace

InputFolder::Files::~Files() {
  // with the folders: what is left of one input must not be found by the next
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored))
    std::filesystem::remove_all(entry.path(), ignored);
}

InputFolder::InputFolder() {
  const bool memory = std::filesystem::exists("/dev/shm");
  std::string name = (memory ? "/dev/shm" : std::filesystem::temp_directory_path().string()) +
                     std::string("/hiac-fuzz-XXXXXX");
  if (mkdtemp(name.data()) == nullptr) std::abort();
  path_ = name;
}

InputFolder::~InputFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

InputFolder::Files InputFolder::write(std::string_view input, const std::string& main_name) const {
  std::vector<std::filesystem::path> paths;
  const auto write_file = [&](const std::string& name, std::string_view text) {
    const std::filesystem::path path = path_ / name;
    std::error_code failed;
    std::filesystem::create_directories(path.parent_path(), failed);
    std::ofstream(path, std::ios::binary) << text;
    paths.push_back(path);
  };
  std::size_t end = std::min(input.find(kParting), input.size());
  if (end > 0 || input.empty()) write_file(main_name, input.substr(0, end));
  while (end < input.size()) {
    const std::size_t name_begin = end + kParting.size();
    const std::size_t line_end = std::min(input.find('\n', name_begin), input.size());
    // what follows may begin with this line's end
    end = std::min(input.find(kParting, line_end), input.size());
    const std::string_view name = input.substr(name_begin, line_end - name_begin);
    const std::size_t begin = std::min(line_end + 1, end);
    if (is_plain(name)) write_file(std::string(name), input.substr(begin, end - begin));
  }
  if (paths.empty()) write_file(main_name, "");
  return {path_, std::move(paths)};
}

std::string parcel(const std::string& name, const std::string& text) {
  return std::string(kParting) + name + "\n" + text;
}

}  // namespace hiac::fuzz
