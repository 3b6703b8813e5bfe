#include "tools/common/render/movie.hpp"

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/integer_pixels.hpp"
#include "hiac/mesh/file_descriptor.hpp"

namespace hiac::tools {
namespace {

constexpr const char* kExtension = ".mp4";
constexpr const char* kFfmpeg = "ffmpeg";

bool is_on_path(const std::string& program) {
  const char* const folders = std::getenv("PATH");
  std::string_view rest = folders == nullptr ? "" : folders;
  while (!rest.empty()) {
    const std::string_view folder = rest.substr(0, rest.find(':'));
    rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
    const std::string place = fmt::format("{}/{}", folder.empty() ? "." : folder, program);
    if (access(place.c_str(), X_OK) == 0) return true;
  }
  return false;
}

// Players expect even sides, and colours of HDTV with every second sample of chroma.
std::vector<std::string> arguments_for(const Image& first, double rate, const std::string& path) {
  return {kFfmpeg,
          "-hide_banner",
          "-loglevel",
          "error",
          "-f",
          "rawvideo",
          "-pixel_format",
          "rgb24",
          "-video_size",
          fmt::format("{}x{}", first.width(), first.height()),
          "-framerate",
          fmt::format("{}", rate),
          "-i",
          "pipe:0",
          "-vf",
          "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
          "-c:v",
          "libx264",
          "-crf",
          "18",
          "-pix_fmt",
          "yuv420p",
          "-colorspace",
          "bt709",
          "-color_primaries",
          "bt709",
          "-color_trc",
          "bt709",
          "-color_range",
          "tv",
          "-movflags",
          "+faststart",
          "-f",
          "mp4",
          "-y",
          path};
}

std::string last_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

bool is_movie(const std::string& path) { return path.ends_with(kExtension); }

void require_ffmpeg(const std::string& path) {
  if (!is_on_path(kFfmpeg))
    throw Error(ExitCode::internal,
                fmt::format("{}: the program {} is not on PATH (the package {} has it; numbered "
                            "pictures, as -o run-%04d.png, need none)",
                            path, kFfmpeg, kFfmpeg));
}

Movie::Movie(std::string path, double rate, bool linear)
    : path_(std::move(path)), rate_(rate), linear_(linear), file_(path_) {}

Movie::~Movie() {
  if (!ffmpeg_) return;
  kill(ffmpeg_->process, SIGKILL);
  end_of(*ffmpeg_);
}

void Movie::start(const Image& first) {
  // a name that begins with a hyphen is no option
  const std::string& name = file_.temporary_path();
  ffmpeg_.emplace(start_program(
      {kFfmpeg}, arguments_for(first, rate_, name.starts_with('-') ? "./" + name : name),
      ChildPipe::input));
}

void Movie::add(const Image& image) {
  if (!ffmpeg_) start(image);
  const image_files::IntegerPixels pixels = image_files::encode_integers(
      path_, kExtension, image,
      {.linear = linear_, .background_included = true, .attributes = {}, .depth = 8, .format = {}});
  const std::vector<std::uint8_t> bytes(pixels.samples.begin(), pixels.samples.end());
  try {
    write_fully(ffmpeg_->stream.number(), bytes, path_);
  } catch (const InputError&) {
    end();  // its reason is the better one
    throw;
  }
}

void Movie::finish() {
  end();
  file_.commit();
}

// Lets ffmpeg end, and throws why it did so if it failed.
void Movie::end() {
  ChildProgram ended = *std::move(ffmpeg_);
  ffmpeg_.reset();
  { const FileDescriptor closed(std::move(ended.stream)); }
  const ChildEnd how = end_of(ended);
  if (how.signal != 0)
    throw Error(ExitCode::internal,
                fmt::format("{}: {} was ended by signal {}", path_, kFfmpeg, how.signal));
  if (how.is_success()) return;
  const std::string reason = last_line(messages_of(ended));
  throw InputError(path_, fmt::format("{} failed with exit code {}{}", kFfmpeg, how.exit_code,
                                      reason.empty() ? "" : " (" + reason + ")"));
}

}  // namespace hiac::tools
