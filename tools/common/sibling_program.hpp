#pragma once

#include <string>
#include <vector>

namespace hiac::tools {

/// Where a program of ours is looked for: beside this one, in the build tree's folder of it
/// (tools/NAME/hiac-NAME), and, as a bare name, on PATH.
std::vector<std::string> places_of(const std::string& program);

/// Replaces this process by the program, with these arguments (the first is its name), from the
/// first of its places; returns only where there is no such program. Calls nothing but exec, so
/// that it may follow a fork.
void become(const std::vector<std::string>& places, std::vector<char*>& arguments);

/// The arguments as exec wants them: pointers, with a null behind. They point into `arguments`.
std::vector<char*> pointers_to(std::vector<std::string>& arguments);

}  // namespace hiac::tools
