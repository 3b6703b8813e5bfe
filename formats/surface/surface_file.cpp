#include "formats/surface/surface_file.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include "formats/surface/poly.hpp"
#include "formats/vtk/xml/xml_surface.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/process/child_process.hpp"

namespace hiac::formats {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Polygon = std::vector<std::size_t>;

struct Soup {
  std::vector<Point> points;
  std::vector<Polygon> polygons;
};

using SoupReader = std::function<bool(std::istream& file, Soup& soup)>;

const std::map<std::string, SoupReader>& soup_readers() {
  static const std::map<std::string, SoupReader> readers{
      {".stl", [](auto& file, Soup& s) { return CGAL::IO::read_STL(file, s.points, s.polygons); }},
      {".ply", [](auto& file, Soup& s) { return CGAL::IO::read_PLY(file, s.points, s.polygons); }},
      {".obj", [](auto& file, Soup& s) { return CGAL::IO::read_OBJ(file, s.points, s.polygons); }},
      {".off", [](auto& file, Soup& s) { return CGAL::IO::read_OFF(file, s.points, s.polygons); }}};
  return readers;
}

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

// The bytes of a transmitted polygon soup: "+", the points' coordinates, and for each polygon its
// number of corners and its corners; or "-" and the error.
template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string packed(const Soup& soup) {
  std::string bytes = "+";
  append(bytes, std::uint64_t{soup.points.size()});
  for (const Point& p : soup.points)
    for (const double x : {p.x(), p.y(), p.z()}) append(bytes, x);
  append(bytes, std::uint64_t{soup.polygons.size()});
  for (const Polygon& polygon : soup.polygons) {
    append(bytes, std::uint64_t{polygon.size()});
    for (const std::size_t corner : polygon) append(bytes, std::uint64_t{corner});
  }
  return bytes;
}

class Unpacker {
 public:
  Unpacker(std::string_view bytes, const std::string& path) : rest_(bytes), path_(path) {}

  Soup soup() {
    Soup soup;
    for (std::uint64_t count = next<std::uint64_t>(); count > 0; --count) {
      const double x = next<double>(), y = next<double>(), z = next<double>();
      soup.points.emplace_back(x, y, z);
    }
    for (std::uint64_t count = next<std::uint64_t>(); count > 0; --count) {
      Polygon polygon;
      for (std::uint64_t left = next<std::uint64_t>(); left > 0; --left)
        polygon.push_back(next<std::uint64_t>());
      soup.polygons.push_back(std::move(polygon));
    }
    return soup;
  }

 private:
  template <typename T>
  T next() {
    if (rest_.size() < sizeof(T)) throw InputError(path_, "is malformed (CGAL was led astray)");
    T value;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return value;
  }

  std::string_view rest_;
  const std::string& path_;
};

std::string answer_of(const std::string& path, const SoupReader& read) {
  try {
    std::ifstream file(path, std::ios::binary);
    Soup soup;
    if (!file) return fmt::format("-cannot be opened ({})", std::strerror(errno));
    if (!read(file, soup)) return "-is malformed (a surface of polygons expected)";
    return packed(soup);
  } catch (const std::bad_alloc&) {
    return "-is malformed (it announces more than it holds)";
  } catch (const std::exception& error) {
    return fmt::format("-is malformed ({})", error.what());
  }
}

std::uint64_t size_of_regular_file(const std::string& path) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error) throw InputError(path, fmt::format("cannot be opened ({})", error.message()));
  return size;
}

// CGAL's readers trust the counts that a file declares, and follow null pointers in damaged PLY
// files: they run in a process of their own, with memory in proportion to the file.
Soup read_soup(const std::string& path, const SoupReader& read) {
  constexpr std::uint64_t kLeastBytes = 256 << 20;
  constexpr std::uint64_t kBytesForByte = 100;  // a polygon "3 0 1 2" takes a vector
  constexpr std::uint64_t kLeastSeconds = 60;
  constexpr std::uint64_t kBytesPerSecond = 1'000'000;
  const std::uint64_t size = size_of_regular_file(path);
  const auto answer = in_child_process([&] { return answer_of(path, read); },
                                       {.memory_bytes = kLeastBytes + kBytesForByte * size,
                                        .seconds = kLeastSeconds + size / kBytesPerSecond});
  if (!answer || answer->empty())
    throw InputError(path, "is malformed (CGAL breaks down on it, or does not come to an end)");
  if (answer->front() == '-') throw InputError(path, answer->substr(1));
  return Unpacker(std::string_view(*answer).substr(1), path).soup();
}

// The corners with which a polygon is cut into triangles: all share its smallest corner.
void append_triangles(const Polygon& polygon, Surface& surface) {
  const std::size_t count = polygon.size();
  const auto least = static_cast<std::size_t>(std::ranges::min_element(polygon) - polygon.begin());
  const auto corner = [&](std::size_t k) {
    return static_cast<std::uint32_t>(polygon[(least + k) % count]);
  };
  for (std::size_t k = 2; k < count; ++k)
    surface.facets.push_back({{{corner(0), corner(k - 1), corner(k)}}, {}});
}

SurfaceReading from_soup(const std::string& path, const Soup& soup) {
  SurfaceReading reading;
  Surface& surface = reading.surface;
  for (const Point& p : soup.points) {
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
      throw InputError(
          path, fmt::format("a coordinate of point {} is not finite", surface.points.size()));
    surface.points.push_back({p.x(), p.y(), p.z()});
  }
  std::size_t cut = 0;
  for (const Polygon& polygon : soup.polygons) {
    if (polygon.size() < 3)
      throw InputError(path,
                       fmt::format("a polygon of {} corners (3 or more expected)", polygon.size()));
    for (const std::size_t corner : polygon)
      if (corner >= surface.points.size())
        throw InputError(path, fmt::format("a polygon has corner {} (less than {} expected)",
                                           corner, surface.points.size()));
    cut += polygon.size() > 3 ? 1 : 0;
    append_triangles(polygon, surface);
  }
  if (cut > 0) reading.notes.push_back(fmt::format("cut {} polygons in triangles", cut));
  return reading;
}

SurfaceReading from_xml(const std::string& path) {
  const vtk::XmlSurface xml = vtk::read_xml_surface(path);
  Soup soup;
  for (std::size_t p = 0; p < xml.xyz.size(); p += 3)
    soup.points.emplace_back(xml.xyz[p], xml.xyz[p + 1], xml.xyz[p + 2]);
  for (const auto& polygon : xml.polygons)
    soup.polygons.emplace_back(polygon.begin(), polygon.end());
  SurfaceReading reading = from_soup(path, soup);
  reading.notes.insert(reading.notes.begin(), xml.notes.begin(), xml.notes.end());
  return reading;
}

}  // namespace

bool is_surface_file(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".poly" || extension == ".smesh" || extension == ".vtp" ||
         soup_readers().contains(extension);
}

bool may_hold_surface(const std::string& path) {
  return is_surface_file(path) || extension_of(path) == ".vtu";
}

SurfaceReading read_surface(const std::string& path) {
  const std::string extension = extension_of(path);
  if (!may_hold_surface(path))
    throw InputError(path,
                     "unknown kind of surface (.stl, .ply, .obj, .off, .vtp, .vtu, .poly or .smesh "
                     "expected)");
  SurfaceReading reading;
  if (const auto reader = soup_readers().find(extension); reader != soup_readers().end())
    reading = from_soup(path, read_soup(path, reader->second));
  else if (extension == ".vtp" || extension == ".vtu")
    reading = from_xml(path);
  else
    reading = {read_poly(path), {}, true};
  if (reading.surface.facets.empty())
    throw InputError(path, "holds no polygon (a surface expected)");
  return reading;
}

}  // namespace hiac::formats
