#include "formats/surface/surface_file.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <utility>

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include "formats/surface/poly.hpp"
#include "hiac/base/error.hpp"

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

Soup read_soup(const std::string& path, const SoupReader& read) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, fmt::format("cannot be opened ({})", std::strerror(errno)));
  Soup soup;
  bool whole = false;
  try {
    whole = read(file, soup);
  } catch (const std::exception& e) {  // sizes that the file only announces
    throw InputError(path, fmt::format("is malformed ({})", e.what()));
  }
  if (!whole) throw InputError(path, "is malformed (a surface of polygons expected)");
  return soup;
}

// Corners through which a polygon is cut in triangles: the least is in all of them.
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

}  // namespace

bool is_surface_file(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".poly" || extension == ".smesh" || soup_readers().contains(extension);
}

SurfaceReading read_surface(const std::string& path) {
  const std::string extension = extension_of(path);
  const auto reader = soup_readers().find(extension);
  if (reader == soup_readers().end() && !is_surface_file(path))
    throw InputError(path,
                     "unknown kind of surface (.stl, .ply, .obj, .off, .poly or .smesh "
                     "expected)");
  SurfaceReading reading;
  if (reader == soup_readers().end())
    reading = {read_poly(path), {}, true};
  else
    reading = from_soup(path, read_soup(path, reader->second));
  if (reading.surface.facets.empty())
    throw InputError(path, "holds no polygon (a surface expected)");
  return reading;
}

}  // namespace hiac::formats
