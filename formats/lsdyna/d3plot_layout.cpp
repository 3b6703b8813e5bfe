#include "formats/lsdyna/d3plot_layout.hpp"

#include <array>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

namespace hiac::formats::lsdyna {
namespace {

constexpr std::size_t kControlWords = 64;
// control words, by their number from 0
constexpr std::size_t kFileType = 11;
constexpr std::size_t kDimension = 15;
constexpr std::size_t kNodes = 16;
constexpr std::size_t kGlobals = 18;
constexpr std::size_t kThermal = 19;
constexpr std::size_t kCoordinates = 20;
constexpr std::size_t kVelocity = 21;
constexpr std::size_t kAcceleration = 22;
constexpr std::size_t kSolids = 23;
constexpr std::size_t kSolidValues = 27;
constexpr std::size_t kBeams = 28;
constexpr std::size_t kBeamValues = 30;
constexpr std::size_t kShells = 31;
constexpr std::size_t kShellValues = 33;
constexpr std::size_t kDeletion = 36;
constexpr std::size_t kParticles = 37;
constexpr std::size_t kUserNumbers = 39;
constexpr std::size_t kThickShells = 40;
constexpr std::size_t kThickShellValues = 42;
constexpr std::size_t kFluids = 47;
constexpr std::size_t kFlow = 48;
constexpr std::size_t kMaterials = 51;
constexpr std::size_t kAirParticles = 54;
constexpr std::size_t kShells8 = 55;
constexpr std::size_t kRates = 56;
constexpr std::size_t kExtra = 57;
constexpr std::size_t kSolids20 = 64;
constexpr std::size_t kThermalValues = 65;
constexpr std::size_t kSolids27 = 66;

constexpr std::int64_t kRigid = 20;  ///< the material of rigid bodies

bool is_file_type(std::int64_t type) { return type == 1 || type == 5 || type == 11; }

class Control {
 public:
  explicit Control(Words& words) : words_(words) {}

  Layout read() {
    const std::int64_t dimension = words_.integer(kDimension);
    layout_.nodes = count(kNodes, 1);
    const std::int64_t solids = words_.integer(kSolids);
    layout_.ten_nodes = solids < 0;
    layout_.solids = limited(std::abs(solids), "solids");
    refuse();
    layout_.globals = count(kGlobals, 1);
    read_node_data();
    layout_.solid_values = count(kSolidValues, 0);
    const std::int64_t extra = words_.integer(kExtra);
    std::size_t at = kControlWords;
    if (extra > 0) {
      at += limited(extra, "further control words");
      layout_.thermal_values = count(kThermalValues, 0);
      for (const std::size_t word : {kSolids20, kSolids27})
        if (words_.integer(word) > 0)
          words_.fail("holds solids of 20 or 27 nodes, which are not read");
    }
    at = skip_materials(at, dimension == 5);
    at += limited(words_.integer(kFluids), "fluid materials");
    layout_.coordinates = at;
    at += 3 * layout_.nodes;
    layout_.connectivity = at;
    at += 9 * layout_.solids + 9 * layout_.thick_shells + 6 * layout_.beams;
    shells_at_ = at;
    at += 5 * layout_.shells + count(kUserNumbers, 1);
    layout_.more_nodes = at;
    if (layout_.ten_nodes) at += 2 * layout_.solids;
    at += 5 * count(kShells8, 0);
    if (at > words_.size())
      words_.fail(fmt::format("the model takes {} words ({} found)", at, words_.size()));
    layout_.first_state = after_titles(at);
    lay_out_states();
    return layout_;
  }

 private:
  /// A count of items, at most the number of words in the file.
  std::size_t limited(std::int64_t value, const char* what) {
    if (value < 0 || static_cast<std::uint64_t>(value) > words_.size())
      words_.fail(fmt::format("{} {} are more than the file holds", value, what));
    return static_cast<std::size_t>(value);
  }
  std::size_t count(std::size_t word, std::int64_t scale) {
    const std::int64_t value = words_.integer(word);
    // counts per node or element are small
    if (scale == 0 && (value < 0 || value > 100'000))
      words_.fail(
          fmt::format("control word {}: a small count expected ({} found)", word + 1, value));
    return limited(value, "things");
  }

  void refuse() {
    const std::int64_t dimension = words_.integer(kDimension);
    if (dimension == 7) words_.fail("holds rigid roads, which are not read");
    if (dimension < 3 || dimension > 5)
      words_.fail(fmt::format("a model of dimension code {} (3, 4 or 5 expected)", dimension));
    for (const auto& [word, what] :
         std::array<std::pair<std::size_t, const char*>, 3>{{{kParticles, "SPH particles"},
                                                             {kAirParticles, "airbag particles"},
                                                             {kFlow, "CFD data"}}})
      if (words_.integer(word) != 0) words_.fail(fmt::format("holds {}, which are not read", what));
    layout_.thick_shells = count(kThickShells, 1);
    layout_.beams = count(kBeams, 1);
    layout_.shells = count(kShells, 1);
  }

  /// Thermal data between coordinates and velocity: temperatures in one or three layers, the flux,
  /// the added mass, the rate, residuals.
  void read_node_data() {
    constexpr std::array<std::size_t, 4> kWords{0, 1, 4, 6};
    const std::int64_t thermal = words_.integer(kThermal);
    const std::int64_t rates = words_.integer(kRates);
    if (thermal < 0 || thermal % 10 > 3)
      words_.fail(fmt::format("a thermal flag from 0 to 3 expected ({} found)", thermal));
    // three layers of temperatures are not read as separate fields
    layout_.has_temperature = thermal % 10 == 1 || thermal % 10 == 2;
    layout_.temperatures = kWords[static_cast<std::size_t>(thermal % 10)];
    if (thermal / 10 % 10 == 1) ++layout_.temperatures;
    if (rates % 10 == 1) ++layout_.temperatures;
    if (rates / 10 % 10 == 1) layout_.temperatures += 6;
    layout_.has_coordinates = words_.integer(kCoordinates) != 0;
    layout_.has_velocity = words_.integer(kVelocity) != 0;
    layout_.has_acceleration = words_.integer(kAcceleration) != 0;
    const std::int64_t deletion = words_.integer(kDeletion);
    if (deletion < 0) layout_.deletion = deletion <= -10'000 ? 2 : 1;
  }

  std::size_t skip_materials(std::size_t at, bool there) {
    materials_at_ = there ? at + 2 : 0;
    if (!there) return at;
    return at + 2 + count(kMaterials, 1);
  }

  /// Shells of rigid bodies have no values.
  std::size_t rigid_shells() {
    if (materials_at_ == 0) return 0;
    const std::size_t materials = count(kMaterials, 1);
    std::size_t rigid = 0;
    for (std::size_t s = 0; s < layout_.shells; ++s) {
      const std::int64_t material = words_.integer(shells_at_ + 5 * s + 4);
      if (material >= 1 && static_cast<std::size_t>(material) <= materials &&
          words_.integer(materials_at_ + static_cast<std::size_t>(material) - 1) == kRigid)
        ++rigid;
    }
    return rigid;
  }

  /// Titles of parts and contacts lie between two end marks.
  std::size_t after_titles(std::size_t at) {
    if (at >= words_.size() || words_.real(at) != kEndMark) return at;
    ++at;
    constexpr std::int64_t kTitle = 90000;
    constexpr std::int64_t kParts = 90001;
    constexpr std::int64_t kContacts = 90002;
    const std::size_t bytes = words_.word_bytes();
    while (at < words_.size()) {
      const std::int64_t type = words_.integer(at);
      if (type == kTitle) {
        at += 1 + 72 / bytes;
      } else if (type == kParts || type == kContacts) {
        // a number and 72 characters each
        at += 2 + limited(words_.integer(at + 1), "titles") * (1 + 72 / bytes);
      } else {
        break;
      }
      // the titles end with their own end mark
      if (at < words_.size() && words_.real(at) == kEndMark) return at + 1;
    }
    return at;
  }

  void lay_out_states() {
    const std::size_t coordinates = (layout_.has_coordinates ? 3U : 0U) +
                                    (layout_.has_velocity ? 3U : 0U) +
                                    (layout_.has_acceleration ? 3U : 0U);
    layout_.node_data = 1 + layout_.globals;
    layout_.thermal_data = layout_.node_data + layout_.nodes * (layout_.temperatures + coordinates);
    layout_.solid_data = layout_.thermal_data + layout_.solids * layout_.thermal_values;
    const std::size_t rigid = rigid_shells();
    layout_.deletion_data = layout_.solid_data + layout_.solids * layout_.solid_values +
                            layout_.thick_shells * count(kThickShellValues, 0) +
                            layout_.beams * count(kBeamValues, 0) +
                            (layout_.shells - rigid) * count(kShellValues, 0);
    layout_.state_words = layout_.deletion_data;
    if (layout_.deletion == 1) layout_.state_words += layout_.nodes;
    if (layout_.deletion == 2)
      layout_.state_words += layout_.solids + layout_.thick_shells + layout_.shells + layout_.beams;
  }

  Words& words_;
  Layout layout_;
  std::size_t shells_at_ = 0;
  std::size_t materials_at_ = 0;
};

}  // namespace

Words::Words(std::string_view bytes, std::size_t word_bytes, std::endian order,
             const std::string& subject)
    : stream_(bytes, subject), word_bytes_(word_bytes), order_(order) {
  stream_.set_order(order);
}

std::int64_t Words::integer(std::size_t word) {
  if (word >= size()) stream_.fail(fmt::format("word {} expected ({} found)", word + 1, size()));
  stream_.move_to(word * word_bytes_);
  return word_bytes_ == 4 ? stream_.read<std::int32_t>("a word")
                          : stream_.read<std::int64_t>("a word");
}

double Words::real(std::size_t word) {
  if (word >= size()) stream_.fail(fmt::format("word {} expected ({} found)", word + 1, size()));
  stream_.move_to(word * word_bytes_);
  return word_bytes_ == 4 ? static_cast<double>(stream_.read<float>("a word"))
                          : stream_.read<double>("a word");
}

std::optional<WordKind> word_kind(std::string_view head) {
  for (const std::size_t bytes : {std::size_t{4}, std::size_t{8}})
    for (const std::endian order : {std::endian::little, std::endian::big}) {
      if (head.size() < kControlWords * bytes) continue;
      Words words(head, bytes, order, "");
      const std::int64_t dimension = words.integer(kDimension);
      if (is_file_type(words.integer(kFileType)) && dimension >= 2 && dimension <= 9 &&
          words.integer(kNodes) > 0 && words.integer(kSolidValues) >= 0)
        return WordKind{bytes, order};
    }
  return std::nullopt;
}

Layout read_layout(Words& words) { return Control(words).read(); }

}  // namespace hiac::formats::lsdyna
