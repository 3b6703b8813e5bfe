#include "tests/fuzz/target.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>

#include "formats/common/io/mapped_file.hpp"
#include "formats/registry.hpp"
#include "formats/surface/point_file.hpp"
#include "formats/surface/surface_file.hpp"
#include "hiac/base/error.hpp"
#include "tests/fuzz/input_files.hpp"
#include "tests/fuzz/other_targets.hpp"

#ifdef HIAC_WITH_NETCDF
#  include "formats/exodus/classic_layout.hpp"
#endif

namespace hiac::fuzz {
namespace {

/// Two directions of one reader: what is in a file, and its mesh.
void read_format(const formats::Format& format, const std::string& path) {
  const formats::Reading reading = format.read(path, {});
  validate(reading.mesh, path);
  format.inspect(path);
}

[[noreturn]] void report(const char* what) {
  std::fprintf(stderr, "%s: %s\n", target().name.c_str(), what);
  std::abort();
}

}  // namespace

Target target_named(const std::string& name) {
#ifdef HIAC_WITH_OTHER_TARGETS
  if (const std::optional<Target> other = other_target(name)) return *other;
#endif
  if (name == "points")
    return {name, ".csv", [](const std::string& path) { formats::read_points(path); }};
  if (formats::is_surface_file("input." + name))
    return {name, "." + name, [](const std::string& path) { formats::read_surface(path); }};
  if (name == "vtu-surface")
    return {name, ".vtu", [](const std::string& path) { formats::read_surface(path); }};
#ifdef HIAC_WITH_NETCDF
  if (name == "classic-netcdf")
    return {name, ".e", [](const std::string& path) {
              const formats::MappedFile file(path);
              if (formats::exodus::is_classic_netcdf(file.text()))
                formats::exodus::check_classic_layout(file.text(), path);
            }};
#endif
  const formats::Format& format = formats::format_named(name);
  return {name, std::string(format.extensions.front()),
          [&format](const std::string& path) { read_format(format, path); }};
}

const Target& target() {
  static const Target found = [] {
    const char* name = std::getenv("HIAC_FUZZ_FORMAT");
    return target_named(name == nullptr ? "" : name);
  }();
  return found;
}

void read_input(std::string_view input) {
  static const InputFolder folder;
  const InputFolder::Files files = folder.write(input, "input" + target().extension);
  target().read(files.main());
}

}  // namespace hiac::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using hiac::fuzz::report;
  try {
    hiac::fuzz::read_input({reinterpret_cast<const char*>(data), size});
  } catch (const hiac::InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos)
      report("error of two lines");
  } catch (const std::exception& error) {
    report(error.what());
  }
  return 0;
}
