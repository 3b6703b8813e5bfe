#pragma once

#include <string>
#include <vector>

#include "tools/common/file_kind.hpp"

namespace hiac::tools {

/// A file that a run is to write. An empty path and "-" (stdout) are no files.
struct RunOutput {
  std::string option;  ///< as errors name it: "-o", "--json"
  std::string path;
  FileKind kind = FileKind::facts;
  /// The run may write over its own input: it makes the same kind of file from it.
  bool may_replace_input = false;
};

/// The files that a run reads and writes.
struct RunFiles {
  std::vector<std::string> inputs;
  std::vector<RunOutput> outputs;
};

/// Refuses outputs that would destroy something: a file that this run reads, one that it writes
/// under another option, or a file of another kind of ours (UsageError); and outputs that cannot be
/// written (InputError). Devices and pipes are written to and never refused.
void require_safe(const RunFiles& files);

/// Throws UsageError where the output would replace a file of another kind.
void require_same_kind(const RunOutput& output);

/// The files of an image: its path, or for a .f32 image the files of its channels, R G B A and
/// further ones.
std::vector<std::string> image_parts(const std::string& path,
                                     const std::vector<std::string>& further_channels = {});

/// An image among the outputs, with all its files.
void add_image(std::vector<RunOutput>& outputs, const std::string& option, const std::string& path,
               const std::vector<std::string>& further_channels = {});

}  // namespace hiac::tools
