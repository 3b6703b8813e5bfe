#include "tools/common/sibling_program.hpp"

#include <filesystem>
#include <string_view>
#include <system_error>

#include <unistd.h>

namespace hiac::tools {

std::vector<std::string> places_of(const std::string& program) {
  constexpr std::string_view kPrefix = "hiac-";
  std::vector<std::string> places;
  std::error_code unknown;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (!unknown) {
    const auto folder = self.parent_path();
    places.push_back((folder / program).string());
    if (program.starts_with(kPrefix))
      places.push_back((folder.parent_path() / program.substr(kPrefix.size()) / program).string());
  }
  places.push_back(program);
  return places;
}

void become(const std::vector<std::string>& places, std::vector<char*>& arguments) {
  for (const std::string& place : places) {
    if (place.find('/') == std::string::npos)
      execvp(place.c_str(), arguments.data());
    else
      execv(place.c_str(), arguments.data());
  }
}

std::vector<char*> pointers_to(std::vector<std::string>& arguments) {
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace hiac::tools
