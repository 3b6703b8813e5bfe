#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "hiac/preview/exact_shaders.hpp"

namespace hiac::preview {
namespace {

// Numbers in GLSL. What is beyond single precision is as far away as shaders need.
std::string single(double v) {
  const double most = 1e37;
  v = v > most ? most : v < -most ? -most : v;
  return fmt::format("{:.9e}", v);
}

std::string real(const ExactVariant& variant, double v) {
  if (!variant.fine) return single(v);
  const double most = 1e200;
  v = v > most ? most : v < -most ? -most : v;
  return fmt::format("{:.17e}lf", v);
}

// Tables as chains of choices, which compilers turn into selections: faster than memory that is
// indexed for the few intervals that functions have.
class Chain {
 public:
  Chain(const ExactVariant& variant, const DrawnField& field) : variant_(variant), field_(field) {}

  template <std::size_t N>
  std::string interval(const std::string& name, const TransferTable<N>& table) const {
    std::string text = fmt::format("int {}_interval(real s, bool up) {{\n  int k = 0;\n", name);
    for (std::size_t k = 1; k < table.intervals(); ++k)
      fmt::format_to(std::back_inserter(text), "  k += (up ? s >= {0} : s > {0}) ? 1 : 0;\n",
                     bound(table.lower[k]));
    return text + "  return k;\n}\n";
  }

  [[nodiscard]] std::string bound(double scalar) const {
    return real(variant_, field_.scaled(scalar));
  }
  [[nodiscard]] double slope(double of_scalar) const { return of_scalar * field_.half; }

 private:
  const ExactVariant& variant_;
  const DrawnField& field_;
};

std::string vec3(double a, double b, double c) {
  return fmt::format("vec3({}, {}, {})", single(a), single(b), single(c));
}

// The members' values on interval k; `tau`, `kappa`: null where the struct has none.
std::string members(const Chain& chain, const TransferTable<1>* tau, const TransferTable<3>* kappa,
                    std::size_t k) {
  const auto& lower = tau != nullptr ? tau->lower : kappa->lower;
  const auto& upper = tau != nullptr ? tau->upper : kappa->upper;
  // values at the interval's end, where there is one, so that they are exact at breakpoints
  const double anchor = k > 0 ? lower[k] : upper[k];
  const double at = std::abs(anchor) < std::numeric_limits<double>::infinity() ? anchor : 0;
  std::string text = fmt::format("t.low = {}; t.high = {}; t.anchor = {}; ", chain.bound(lower[k]),
                                 chain.bound(upper[k]), chain.bound(at));
  if (tau != nullptr)
    text += fmt::format("t.value = {}; t.slope = {}; ",
                        single(tau->value[0][k] + tau->slope[0][k] * (at - tau->anchor[k])),
                        single(chain.slope(tau->slope[0][k])));
  if (kappa != nullptr) {
    std::array<double, 3> value{}, slope{};
    for (std::size_t c = 0; c < 3; ++c) {
      value[c] = kappa->value[c][k] + kappa->slope[c][k] * (at - kappa->anchor[k]);
      slope[c] = chain.slope(kappa->slope[c][k]);
    }
    text += fmt::format("t.color = {}; t.color_slope = {}; ", vec3(value[0], value[1], value[2]),
                        vec3(slope[0], slope[1], slope[2]));
  }
  return text;
}

std::string lookup(const Chain& chain, const std::string& type, const std::string& name,
                   const TransferTable<1>* tau, const TransferTable<3>* kappa) {
  const std::size_t intervals = tau != nullptr ? tau->intervals() : kappa->intervals();
  std::string text = fmt::format("{0} {1}_at(int k) {{\n  {0} t;\n  {2}\n", type, name,
                                 members(chain, tau, kappa, 0));
  for (std::size_t k = 1; k < intervals; ++k)
    fmt::format_to(std::back_inserter(text), "  if (k >= {}) {{ {}}}\n", k,
                   members(chain, tau, kappa, k));
  return text + "  return t;\n}\n";
}

}  // namespace

std::string transfer_source(const ExactVariant& variant, const DrawnScene& scene) {
  const OpticsTables& optics = scene.optics;
  const bool same = optics.same_field;
  const Chain of_tau(variant, scene.fields[scene.extinction]);
  const Chain of_kappa(variant, scene.fields[scene.color]);
  std::string text = same ? "#define SEPARATE 0\n" : "#define SEPARATE 1\n";
  text += "struct Extinction { real low, high, anchor; float value, slope;";
  text += same ? " vec3 color, color_slope; };\n" : " };\n";
  if (!same) text += "struct Color { real low, high, anchor; vec3 color, color_slope; };\n";
  text += of_tau.interval("extinction", optics.extinction);
  text += lookup(of_tau, "Extinction", "extinction", &optics.extinction,
                 same ? &optics.color : nullptr);
  if (!same) {
    text += of_kappa.interval("color", optics.color);
    text += lookup(of_kappa, "Color", "color", nullptr, &optics.color);
  }
  return text;
}

}  // namespace hiac::preview
