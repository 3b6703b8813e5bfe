#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "hiac/preview/exact_shaders.hpp"

namespace hiac::preview {
namespace {

// Numbers in GLSL. What is beyond single precision is as far away as shaders need.
double bounded(double v) { return std::clamp(v, -1e37, 1e37); }

std::string single(double v) { return fmt::format("{:.9e}", bounded(v)); }

std::string real(const ExactVariant& variant, double v) {
  if (!variant.fine) return single(v);
  return fmt::format("{:.17e}lf", bounded(v));
}

// More intervals than this are looked up in a table: chains grow with their number.
constexpr std::size_t kMostInChain = 32;

// One interval of a field's functions, scalars scaled as the field. Values are those at its low
// end, so that they are exact at breakpoints; below the first one functions are constant.
struct Interval {
  double low, high;             // infinite at the ends
  double value = 0, slope = 0;  // extinction
  std::array<double, 3> color{}, color_slope{};
};

// `tau`, `kappa`: the functions of the field that there are; their intervals are the same.
std::vector<Interval> intervals_of(const DrawnField& field, const TransferTable<1>* tau,
                                   const TransferTable<3>* kappa) {
  const auto& lower = tau != nullptr ? tau->lower : kappa->lower;
  const auto& upper = tau != nullptr ? tau->upper : kappa->upper;
  std::vector<Interval> all;
  for (std::size_t k = 0; k < lower.size(); ++k) {
    Interval i{field.scaled(lower[k]), field.scaled(upper[k])};
    const auto at_low = [&](double value, double slope, double anchor) {
      return k > 0 ? value + slope * (lower[k] - anchor) : value;
    };
    if (tau != nullptr) {
      i.value = at_low(tau->value[0][k], tau->slope[0][k], tau->anchor[k]);
      i.slope = tau->slope[0][k] * field.half;
    }
    for (std::size_t c = 0; kappa != nullptr && c < 3; ++c) {
      i.color[c] = at_low(kappa->value[c][k], kappa->slope[c][k], kappa->anchor[k]);
      i.color_slope[c] = kappa->slope[c][k] * field.half;
    }
    all.push_back(i);
  }
  return all;
}

std::string vec3(const std::array<double, 3>& v) {
  return fmt::format("vec3({}, {}, {})", single(v[0]), single(v[1]), single(v[2]));
}

// What a function's shader code is written for.
struct Function {
  std::string name;  // of the field's role, lower case
  std::string type;  // of an interval
  bool tau, kappa;
  std::vector<Interval> intervals;
};

std::vector<Function> functions_of(const DrawnScene& scene) {
  const OpticsTables& optics = scene.optics;
  const bool same = optics.same_field;
  std::vector<Function> all{{"extinction", "Extinction", true, same,
                             intervals_of(scene.fields[scene.extinction], &optics.extinction,
                                          same ? &optics.color : nullptr)}};
  if (!same)
    all.push_back({"color", "Color", false, true,
                   intervals_of(scene.fields[scene.color], nullptr, &optics.color)});
  return all;
}

// Tables as chains of choices, which compilers turn into selections: faster than memory that is
// indexed for the few intervals that functions have.
std::string chain_source(const ExactVariant& variant, const Function& function) {
  std::string text = fmt::format("int {}_interval(real s) {{\n  int k = 0;\n", function.name);
  const auto& intervals = function.intervals;
  for (std::size_t k = 1; k < intervals.size(); ++k)
    fmt::format_to(std::back_inserter(text), "  k += s >= {} ? 1 : 0;\n",
                   real(variant, intervals[k].low));
  text += fmt::format("  return k;\n}}\n{0} {1}_at(int k) {{\n  {0} t;\n", function.type,
                      function.name);
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    const Interval& i = intervals[k];
    if (k > 0) text += fmt::format("  if (k >= {}) {{\n", k);
    text +=
        fmt::format("  t.low = {}; t.high = {};\n", real(variant, i.low), real(variant, i.high));
    if (function.tau)
      text += fmt::format("  t.value = {}; t.slope = {};\n", single(i.value), single(i.slope));
    if (function.kappa)
      text +=
          fmt::format("  t.color = {}; t.color_slope = {};\n", vec3(i.color), vec3(i.color_slope));
    if (k > 0) text += "  }\n";
  }
  return text + "  return t;\n}\n";
}

// The same from a table of three texels an interval (transfer_texels).
std::string table_source(const Function& function, std::size_t unit) {
  std::string text = fmt::format(
      "layout(binding = {2}) uniform samplerBuffer {1}_table;\n"
      "int {1}_interval(real s) {{\n"
      "  int low = 0, high = {3};\n"
      "  for (int step = 0; step < 17; ++step) {{\n"
      "    int k = (low + high + 1) / 2;\n"
      "    real t = real(texelFetch({1}_table, 3 * k).x) + real(texelFetch({1}_table, 3 * k + "
      "2).z);\n"
      "    bool above = low < high && s >= t;\n"
      "    low = above ? k : low;\n"
      "    high = low < high && !above ? k - 1 : high;\n"
      "  }}\n"
      "  return low;\n}}\n"
      "{0} {1}_at(int k) {{\n  {0} t;\n  k = 3 * clamp(k, 0, {3});\n"
      "  vec4 a = texelFetch({1}_table, k), b = texelFetch({1}_table, k + 1);\n"
      "  vec4 c = texelFetch({1}_table, k + 2);\n"
      "  t.low = real(a.x) + real(c.z); t.high = real(a.y) + real(c.w);\n",
      function.type, function.name, unit, function.intervals.size() - 1);
  if (function.tau) text += "  t.value = a.z; t.slope = a.w;\n";
  if (function.kappa) text += "  t.color = b.xyz; t.color_slope = vec3(b.w, c.xy);\n";
  return text + "  return t;\n}\n";
}

std::vector<float> texels_of(const Function& function) {
  std::vector<float> texels;
  const auto put = [&](double v) {
    texels.push_back(static_cast<float>(bounded(v)));
    return bounded(v) - static_cast<double>(texels.back());
  };
  for (const Interval& i : function.intervals) {
    const double low = put(i.low), high = put(i.high);
    for (const double v : {i.value, i.slope, i.color[0], i.color[1], i.color[2], i.color_slope[0],
                           i.color_slope[1], i.color_slope[2], low, high})
      put(v);
  }
  return texels;
}

}  // namespace

std::vector<std::vector<float>> transfer_texels(const DrawnScene& scene) {
  std::vector<std::vector<float>> all;
  for (const Function& function : functions_of(scene)) {
    const bool table = function.intervals.size() > kMostInChain;
    all.push_back(table ? texels_of(function) : std::vector<float>{});
  }
  return all;
}

std::string transfer_source(const ExactVariant& variant, const DrawnScene& scene) {
  const bool same = scene.optics.same_field;
  std::string text = same ? "#define SEPARATE 0\n" : "#define SEPARATE 1\n";
  text += "struct Extinction { real low, high; float value, slope;";
  text += same ? " vec3 color, color_slope; };\n" : " };\n";
  if (!same) text += "struct Color { real low, high; vec3 color, color_slope; };\n";
  const std::vector<Function> functions = functions_of(scene);
  for (std::size_t f = 0; f < functions.size(); ++f)
    text += functions[f].intervals.size() > kMostInChain ? table_source(functions[f], f)
                                                         : chain_source(variant, functions[f]);
  return text;
}

}  // namespace hiac::preview
