#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hiac::fuzz {

/// A folder in memory, gone at the end, for the files of one input after the other.
class InputFolder {
 public:
  /// The files of one input, gone with this.
  class Files {
   public:
    Files(std::filesystem::path folder, std::vector<std::filesystem::path>&& paths)
        : folder_(std::move(folder)), paths_(std::move(paths)) {}
    ~Files();
    Files(const Files&) = delete;
    Files& operator=(const Files&) = delete;

    /// The one that is to be read.
    [[nodiscard]] std::string main() const { return paths_.front().string(); }

   private:
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> paths_;
  };

  InputFolder();
  ~InputFolder();
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  /// Writes an input, of which the first file is to be read. A line "==== NAME" begins a further
  /// one of that name; what is before the first such line, if anything, is called `main_name`. What
  /// has a name that is no plain relative path is left out.
  [[nodiscard]] Files write(std::string_view input, const std::string& main_name) const;

 private:
  std::filesystem::path path_;
};

/// A further file in an input.
std::string parcel(const std::string& name, const std::string& text);

}  // namespace hiac::fuzz
