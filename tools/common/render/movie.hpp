#pragma once

#include <optional>
#include <string>

#include "hiac/base/output_file.hpp"
#include "hiac/image/image.hpp"
#include "tools/common/child_program.hpp"

namespace hiac::tools {

/// Whether a picture's name asks for a film: .mp4.
bool is_movie(const std::string& path);

/// Throws Error (internal), which names the package, if ffmpeg is not on PATH.
void require_ffmpeg(const std::string& path);

/// A film, which ffmpeg makes of pictures that it gets through a pipe. The file is complete or not
/// there at all (OutputFile): nothing remains when the object is destroyed without finish, or when
/// a signal ends the process, with which ffmpeg ends, too.
class Movie {
 public:
  /// `rate`: pictures per second. `linear`: linear samples instead of sRGB-encoded ones. Throws
  /// InputError if the file cannot be written.
  Movie(std::string path, double rate, bool linear);
  ~Movie();
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  /// Adds a picture, premultiplied, as over black: its samples are those of an 8-bit PNG with a
  /// background. All have the size of the first. Throws Error with ffmpeg's reason when it has
  /// ended: InputError if it failed, internal if a signal ended it.
  void add(const Image& image);

  /// Waits until ffmpeg has written the film, and gives the file its name. There is a picture.
  /// Throws as `add` does.
  void finish();

 private:
  void start(const Image& first);
  void end();

  std::string path_;
  double rate_;
  bool linear_;
  OutputFile file_;
  std::optional<ChildProgram> ffmpeg_;  // while it runs
};

}  // namespace hiac::tools
