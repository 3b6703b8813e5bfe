#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

#include "hiac/mesh/file_descriptor.hpp"

namespace hiac::tools {

/// Which of a child's streams is joined to this process by a pipe.
enum class ChildPipe : bool { input, output };

/// A program that runs as a child of this process, with an end of the pipe to it. Its stderr, and
/// the stdout that is no pipe, go to a file of memory. It never outlives this process.
struct ChildProgram {
  pid_t process;
  FileDescriptor stream, messages;
};

/// How a child ended.
struct ChildEnd {
  int exit_code = 0;
  int signal = 0;  ///< that ended it; 0: none
  /// Nothing was run: there is no such program in any of the places.
  bool not_found = false;

  [[nodiscard]] bool is_success() const { return exit_code == 0 && signal == 0; }
};

/// Starts the program with these arguments, of which the first is its name, from the first of the
/// places that has it (sibling_program.hpp). Throws Error (internal) when no child can be made.
ChildProgram start_program(const std::vector<std::string>& places,
                           std::vector<std::string> arguments, ChildPipe pipe);

/// Waits for the end of the program.
ChildEnd end_of(const ChildProgram& program);

/// What the program has written to its file of messages so far.
std::string messages_of(const ChildProgram& program);

}  // namespace hiac::tools
