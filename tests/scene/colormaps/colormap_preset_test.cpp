#include "hiac/scene/colormaps/colormap_preset.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace hiac {
namespace {

using Rgb = std::array<double, 3>;

double distance(const Rgb& a, const Rgb& b) {
  double largest = 0;
  for (std::size_t c = 0; c < 3; ++c) largest = std::fmax(largest, std::fabs(a[c] - b[c]));
  return largest;
}

struct Sample {
  double scalar;
  Rgb rgb;
};

/// What vtkColorTransferFunction::GetColor of VTK 9.1 returns.
struct VtkCase {
  const char* name;
  ColormapPreset preset;
  std::vector<Sample> samples;
};

const std::vector<ColormapPreset::Node> kThreeNodes = {
    {0, {1, 0, 0}}, {0.4, {0.2, 0.3, 0.9}}, {1, {0.9, 0.1, 0.5}}};

const std::vector<VtkCase> kVtkCases = {
    {"Cool to Warm",
     {"",
      ColorSpace::diverging,
      {{0, {0.231373, 0.298039, 0.752941}}, {1, {0.705882, 0.0156863, 0.14902}}}},
     {{0.10416666666666667, {0.357036492414691, 0.475321747235635, 0.895038466198899}},
      {0.1875, {0.467248035909008, 0.60417407676303, 0.967848918926219}},
      {0.27083333333333331, {0.582156565552229, 0.71388065996219, 0.998878743050359}},
      {0.35416666666666669, {0.695212325606433, 0.797644504842858, 0.986376699169248}},
      {0.4375, {0.79872707099396, 0.849732505571254, 0.931686984060323}},
      {0.52083333333333337, {0.887730818326376, 0.855030723716889, 0.835987411843151}},
      {0.60416666666666663, {0.950186438030813, 0.791197834751643, 0.710695347439517}},
      {0.6875, {0.970331030387646, 0.694500349886731, 0.579428511992773}},
      {0.77083333333333337, {0.949465319425076, 0.569441373280979, 0.449806307288618}},
      {0.85416666666666663, {0.890026179533201, 0.419832064597849, 0.328209730695204}},
      {0.9375, {0.795940329431882, 0.241514363156249, 0.21962281543986}}}},
    {"Cool to Warm with its grey",
     {"",
      ColorSpace::diverging,
      {{0, {0.231373, 0.298039, 0.752941}},
       {0.5, {0.865003, 0.865003, 0.865003}},
       {1, {0.705882, 0.0156863, 0.14902}}}},
     {{0.10416666666666667, {0.357261808794073, 0.475232536350092, 0.894909926533619}},
      {0.1875, {0.467503769337215, 0.604007442241807, 0.96763177680142}},
      {0.27083333333333331, {0.582332529565493, 0.713636102540952, 0.998592826939296}},
      {0.35416666666666669, {0.695226155955577, 0.797330098946938, 0.98604246166734}},
      {0.4375, {0.798524016220503, 0.849366447943292, 0.931320089437683}},
      {0.52083333333333337, {0.887372874140211, 0.854654357368477, 0.835648164595671}},
      {0.60416666666666663, {0.949923906621986, 0.790876352217155, 0.710530973559631}},
      {0.6875, {0.970144526839606, 0.694249367383922, 0.579401076684704}},
      {0.77083333333333337, {0.949342446281325, 0.569266346542448, 0.449863317665431}},
      {0.85416666666666663, {0.88995701738269, 0.41972876260274, 0.328292370348808}},
      {0.9375, {0.795914969812568, 0.241470699945288, 0.219674928899016}}}},
    {"Lab",
     {"",
      ColorSpace::lab,
      {{0, {0, 0, 0.5}}, {0.3, {0.1, 0.9, 0.2}}, {0.55, {1, 1, 0}}, {1, {0.9, 0.05, 0.7}}}},
     {{0.10416666666666667, {0.294374027086934, 0.33074232600493, 0.449119100411362}},
      {0.1875, {0.327666833202604, 0.566041341641451, 0.385316652525981}},
      {0.27083333333333331, {0.232340155799447, 0.811501042060874, 0.271294205682438}},
      {0.35416666666666669, {0.434699106987096, 0.925765354744083, 0.17731960719127}},
      {0.4375, {0.704407505765688, 0.961074248653989, 0.131676645784153}},
      {0.52083333333333337, {0.92662231679145, 0.990925667360989, 0.0526506388914352}},
      {0.60416666666666663, {1, 0.907283447639999, 0.244769810929652}},
      {0.6875, {1, 0.772903160698133, 0.389064206426375}},
      {0.77083333333333337, {0.992770172735559, 0.636555772449145, 0.491945814374383}},
      {0.85416666666666663, {0.968926938028872, 0.4856030946462, 0.575011598825925}},
      {0.9375, {0.933891888980924, 0.305333191032969, 0.648612017252346}}}},
    {"HSV",
     {"", ColorSpace::hsv, kThreeNodes},
     {{0.10416666666666667, {0.96986192706611, 0.973958333333333, 0.0563633294753087}},
      {0.1875, {0.26319085984003, 0.953125, 0.0992838541666667}},
      {0.27083333333333331, {0.140275366512346, 0.932291666666667, 0.624678192946015}},
      {0.35416666666666669, {0.179337866512346, 0.607497603804977, 0.911458333333333}},
      {0.4375, {0.19375, 0.222126116071429, 0.9}},
      {0.52083333333333337, {0.315244364528219, 0.179861111111111, 0.9}},
      {0.60416666666666663, {0.471453028549383, 0.165972222222222, 0.9}},
      {0.6875, {0.633999875992063, 0.152083333333333, 0.9}},
      {0.77083333333333337, {0.802884906856261, 0.138194444444444, 0.9}},
      {0.85416666666666663, {0.9, 0.124305555555556, 0.821891878858025}},
      {0.9375, {0.9, 0.110416666666667, 0.640330481150794}}}},
    {"wrapped HSV",
     {"",
      ColorSpace::hsv_wrapped,
      {{0, {1, 0.1, 0}}, {0.4, {0.2, 0.3, 0.9}}, {1, {0.9, 0.1, 0.5}}}},
     {{0.10416666666666667, {0.973958333333333, 0.0563633294753087, 0.500550315717891}},
      {0.1875, {0.953125, 0.0992838541666667, 0.911576479957217}},
      {0.27083333333333331, {0.60075270054552, 0.140275366512346, 0.932291666666667}},
      {0.35416666666666669, {0.262899830508134, 0.179337866512346, 0.911458333333333}},
      {0.4375, {0.19375, 0.222126116071429, 0.9}},
      {0.52083333333333337, {0.315244364528219, 0.179861111111111, 0.9}},
      {0.60416666666666663, {0.471453028549383, 0.165972222222222, 0.9}},
      {0.6875, {0.633999875992063, 0.152083333333333, 0.9}},
      {0.77083333333333337, {0.802884906856261, 0.138194444444444, 0.9}},
      {0.85416666666666663, {0.9, 0.124305555555556, 0.821891878858025}},
      {0.9375, {0.9, 0.110416666666667, 0.640330481150794}}}},
    {"step",
     {"", ColorSpace::step, kThreeNodes},
     {{0.27083333333333331, {0.2, 0.3, 0.9}},
      {0.35416666666666669, {0.2, 0.3, 0.9}},
      {0.4375, {0.9, 0.1, 0.5}},
      {0.52083333333333337, {0.9, 0.1, 0.5}}}}};

TEST(ColormapPreset, AgreesWithVtk) {
  for (const VtkCase& c : kVtkCases)
    for (const Sample& sample : c.samples)
      EXPECT_LT(distance(preset_color(c.preset, sample.scalar), sample.rgb), 2e-12)
          << c.name << " at " << sample.scalar;
}

/// The largest error of the linearized map, by dense sampling.
double sampled_error(const ColormapPreset& preset, const LinearizedPreset& linear, double low,
                     double high) {
  const PiecewiseLinear<3> function(linear.points);
  const double first = preset.nodes.front().scalar;
  const double extent = preset.nodes.back().scalar - first;
  double largest = 0;
  constexpr int kSamples = 20011;  // a prime: no sample meets a point of the subdivision
  for (int i = 0; i < kSamples; ++i) {
    const double t = (i + 0.5) / kSamples;
    const Rgb exact = preset_color(preset, first + t * extent);
    largest = std::fmax(largest, distance(function(low + t * (high - low)), exact));
  }
  return largest;
}

TEST(ColormapPreset, KeepsTheBoundThatItProves) {
  for (const VtkCase& c : kVtkCases)
    for (const double tolerance : {1e-2, 1e-4, 1e-5}) {
      const LinearizedPreset linear = linearize(c.preset, -3, 17, tolerance);
      EXPECT_LE(linear.bound, tolerance) << c.name;
      // an error that is sampled can exceed the bound only by rounding of the scalars
      EXPECT_LE(sampled_error(c.preset, linear, -3, 17), linear.bound + 1e-10) << c.name;
    }
}

TEST(ColormapPreset, KeepsItsBoundOnRandomMaps) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 40; ++trial) {
    ColormapPreset preset{"", static_cast<ColorSpace>(random() % 6), {}};
    double scalar = 0;
    for (int i = 0; i < 4; ++i) {
      preset.nodes.push_back({scalar, {unit(random), unit(random), unit(random)}});
      scalar += unit(random);
    }
    // corners of the colour cube too: black, white and pure colours are where formulas switch
    for (double& channel : preset.nodes[random() % 4].rgb) channel = std::round(channel);
    const LinearizedPreset linear = linearize(preset, 0, 1, 1e-4);
    EXPECT_LE(linear.bound, 1e-4);
    const bool jumps = preset.space == ColorSpace::step;
    if (!jumps) {
      EXPECT_LE(sampled_error(preset, linear, 0, 1), linear.bound + 1e-9);
    }
    EXPECT_LT(linear.points.size(), 2000u);
  }
}

TEST(ColormapPreset, NeedsNoMorePointsThanTheErrorOfStraightLinesAsksFor) {
  // the error of n straight lines falls as 1/n^2
  const std::size_t coarse = linearize(kVtkCases[0].preset, 0, 1, 1e-3).points.size();
  const std::size_t fine = linearize(kVtkCases[0].preset, 0, 1, 1e-5).points.size();
  EXPECT_LT(fine, 20 * coarse);
  EXPECT_LT(linearize(kVtkCases[0].preset, 0, 1, 1e-4).points.size(), 150u);
}

TEST(ColormapPreset, KeepsRgbMapsAsTheyAre) {
  const ColormapPreset preset{"", ColorSpace::rgb, kThreeNodes};
  const LinearizedPreset linear = linearize(preset, 0, 10, 1e-4);
  EXPECT_EQ(linear.bound, 0);
  ASSERT_EQ(linear.points.size(), 3u);
  EXPECT_EQ(linear.points[1].scalar, 4);
  EXPECT_EQ(linear.points[1].value, (Rgb{0.2, 0.3, 0.9}));
  EXPECT_EQ(linear.points[2].scalar, 10);
}

TEST(ColormapPreset, StepsTakeTheColourOfAnIntervalsUpperEnd) {
  const LinearizedPreset linear = linearize({"", ColorSpace::step, kThreeNodes}, 0, 10, 1e-4);
  const PiecewiseLinear<3> function(linear.points);
  EXPECT_EQ(function(-1), kThreeNodes[0].rgb);
  EXPECT_EQ(function(1), kThreeNodes[1].rgb);
  EXPECT_EQ(function(3.9), kThreeNodes[1].rgb);
  EXPECT_EQ(function(4.1), kThreeNodes[2].rgb);
  EXPECT_EQ(function(11), kThreeNodes[2].rgb);
}

TEST(ColormapPreset, KeepsStepsOfNodesAtOneScalar) {
  for (const ColorSpace space : {ColorSpace::rgb, ColorSpace::lab, ColorSpace::diverging}) {
    const ColormapPreset preset{
        "",
        space,
        {{0, {1, 0, 0}}, {0, {0, 1, 0}}, {1, {0, 0, 1}}, {1, {1, 1, 1}}, {2, {0, 0, 0}}}};
    const PiecewiseLinear<3> function(linearize(preset, 0, 2, 1e-4).points);
    EXPECT_LT(distance(function(-1), {1, 0, 0}), 1e-3);
    EXPECT_LT(distance(function(0), {0, 1, 0}), 1e-3);
    EXPECT_LT(distance(function(1 - 1e-9), {0, 0, 1}), 1e-3);
    EXPECT_LT(distance(function(1), {1, 1, 1}), 1e-3);
    EXPECT_LT(distance(function(3), {0, 0, 0}), 1e-3);
  }
}

TEST(ColormapPreset, TakesOneNodeForAConstant) {
  const ColormapPreset preset{"", ColorSpace::lab, {{3, {0.1, 0.2, 0.3}}}};
  const LinearizedPreset linear = linearize(preset, 0, 1, 1e-4);
  ASSERT_EQ(linear.points.size(), 1u);
  EXPECT_EQ(linear.points[0].value, (Rgb{0.1, 0.2, 0.3}));
  EXPECT_THROW(linearize(preset, 1, 1, 1e-4), std::invalid_argument);
}

}  // namespace
}  // namespace hiac
