#include "formats/registry.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkVersionMacros.h>

#include "formats/abaqus/abaqus.hpp"
#include "formats/ansys/ansys.hpp"
#include "formats/boundary/boundary_formats.hpp"
#include "formats/calculix/frd.hpp"
#include "formats/common/io/input_text.hpp"
#include "formats/common/io/named_file.hpp"
#include "formats/gambit/gambit.hpp"
#include "formats/gmsh/gmsh.hpp"
#include "formats/library_formats.hpp"
#include "formats/medit/medit.hpp"
#include "formats/nastran/nastran.hpp"
#include "formats/netgen/netgen.hpp"
#include "formats/su2/su2.hpp"
#include "formats/tecplot/tecplot.hpp"
#include "formats/tetgen/tetgen.hpp"
#include "formats/ucd/ucd.hpp"
#include "formats/ugrid/ugrid.hpp"
#include "formats/unv/unv.hpp"
#include "formats/vtk/vtk_formats.hpp"
#include "formats/zoo/zoo_format.hpp"
#include "formats/zoo/zparts_format.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

std::string lower_extension(const std::string& path) {
  const std::filesystem::path name(path);
  std::string extension = name.extension().string();
  if (extension == ".gz") extension = name.stem().extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool has_extension(const Format& format, std::string_view extension) {
  return std::find(format.extensions.begin(), format.extensions.end(), extension) !=
         format.extensions.end();
}

template <typename Keep>
std::string joined_names(const Keep& keep) {
  std::vector<std::string_view> names;
  for (const Format& format : all_formats())
    if (keep(format)) names.push_back(format.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Describes the contents of a gzip file that cannot be read packed. `head`: its first bytes,
/// unpacked.
[[noreturn]] void refuse_packed(const std::string& path, const std::string& head) {
  for (const Format& format : all_formats())
    if (format.read && format.recognizes(head))
      throw InputError(path, fmt::format("is a {} file packed by gzip, which is not read in this "
                                         "format (gunzip it first)",
                                         format.name));
  throw InputError(path, "is packed by gzip, and what it holds is of no known format");
}

}  // namespace

std::span<const Format> all_formats() {
  static const std::vector<Format> formats = [] {
    std::vector<Format> all;
    all.push_back(zoo_format());
    all.push_back(zparts_format());
    all.push_back(vtk_legacy_format());
    all.push_back(vtu_format());
    all.push_back(pvtu_format());
    all.push_back(vts_format());
    all.push_back(vti_format());
    all.push_back(vtr_format());
    all.push_back(pvts_format());
    all.push_back(pvti_format());
    all.push_back(pvtr_format());
    all.push_back(pvd_format());
    all.push_back(vtm_format());
    all.push_back(gmsh_format());
    all.push_back(abaqus_format());
    all.push_back(frd_format());
    all.push_back(nastran_format());
    all.push_back(ansys_format());
    all.push_back(unv_format());
    all.push_back(ucd_format());
    all.push_back(medit_format());
    all.push_back(ugrid_format());
    all.push_back(su2_format());
    all.push_back(tetgen_format());
    all.push_back(netgen_format());
    all.push_back(gambit_format());
    all.push_back(tecplot_format());
    add_library_formats(all);
    all.push_back(stl_format());
    all.push_back(ply_format());
    all.push_back(vtp_format());
    return all;
  }();
  return formats;
}

const Format& format_named(const std::string& name) {
  for (const Format& format : all_formats())
    if (format.name == name) return format;
  throw UsageError(fmt::format("format {}: there is no such format (expected one of {})", name,
                               joined_names([](const Format&) { return true; })));
}

const Format& format_to_read(const std::string& path) {
  std::string head = file_head(path);
  const std::string extension = lower_extension(path);
  // an empty file may stand for a case of several files
  for (const Format& format : all_formats())
    if (head.empty() && format.contains && format.contains(path)) return format;
  if (head.empty()) throw InputError(path, "is empty (a mesh expected)");
  const bool packed = is_gzip(head);
  if (packed) head = unpacked_head(head, kHeadBytes);
  head = std::string(without_byte_order_mark(head));
  const auto readable = [packed](const Format& format) {
    return format.read && (format.gzip || !packed);
  };
  for (const Format& format : all_formats())
    if (readable(format) && format.recognizes(head)) return format;
  for (const Format& format : all_formats())
    if (readable(format) && format.contains && format.contains(path)) return format;
  for (const Format& format : all_formats())
    if (readable(format) && format.plausible && has_extension(format, extension) &&
        format.plausible(head))
      return format;
  if (packed) refuse_packed(path, head);
  for (const Format& format : all_formats())
    if (format.read && has_extension(format, extension))
      throw InputError(path, fmt::format("is not a {} file, although its name says so (neither "
                                         "this nor any other known format found in its first "
                                         "bytes)",
                                         format.name));
  for (const Format& format : all_formats())
    if (!format.read && has_extension(format, extension))
      throw InputError(path, "is the file of a surface (a mesh of cells with a volume expected)");
  throw InputError(path, fmt::format("unknown file format (one of {} expected)",
                                     joined_names([](const Format& f) { return bool(f.read); })));
}

const Format& format_to_write(const std::string& path) {
  const std::string extension = lower_extension(path);
  for (const Format& format : all_formats())
    if (format.write && has_extension(format, extension)) return format;
  throw UsageError(
      fmt::format("{}: no format with the extension '{}' can be written (expected "
                  "one of {})",
                  path, extension, joined_names([](const Format& f) { return bool(f.write); })));
}

std::string format_library_versions() {
  return fmt::format("VTK {}.{}.{}{}", VTK_MAJOR_VERSION, VTK_MINOR_VERSION, VTK_BUILD_VERSION,
                     further_library_versions());
}

}  // namespace hiac::formats
