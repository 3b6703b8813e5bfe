#pragma once

#include <string>

#include "hiac/mesh/zoo_container.hpp"

namespace hiac::tools {

/// How errors and log lines call an input: the path, or "stdin".
std::string input_name(const std::string& path);

/// Reads a zoo mesh from a file, or from stdin where `path` is "-", or empty with a piped stdin.
/// Throws UsageError when there is nothing to read, InputError when it is malformed.
/// `numbers`: what is asked of the mesh's (read_zoo_file).
ZooFile read_mesh(const std::string& path, MeshNumbers numbers = MeshNumbers::checked);

/// True where data written to `path` goes to stdout: "-", or empty.
bool is_stdout(const std::string& path);

/// Throws UsageError with a hint when binary output would go to a terminal.
void require_binary_output(const std::string& path);

/// Writes a zoo mesh to a file, or to stdout where `path` is "-" or empty.
void write_mesh(const std::string& path, const ZooFile& file);

}  // namespace hiac::tools
