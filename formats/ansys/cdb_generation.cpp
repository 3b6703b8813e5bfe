#include "formats/ansys/cdb_generation.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "formats/common/io/deck_numbers.hpp"

namespace hiac::formats::ansys {
namespace {

void refuse_large(std::int64_t number, const CommandFields& fields) {
  if (number < -kLargestNumber || number > kLargestNumber)
    fields.refuse(fmt::format("numbers of nodes and elements of at most {}, not {},",
                              kLargestNumber, number));
}

}  // namespace

void CdbGeneration::take(const CommandFields& fields, std::size_t numbers) {
  if (numbers > kMostMade - made_)
    fields.refuse(
        fmt::format("at most {} numbers of nodes and elements made by NGEN and EGEN", kMostMade));
  made_ += numbers;
}

std::int64_t CdbGeneration::largest_element(const CommandFields& fields) const {
  const std::vector<std::int64_t>& numbers = model_.mesh.cell_numbers;
  const auto largest = std::max_element(numbers.begin(), numbers.end());
  if (largest == numbers.end()) return 0;
  refuse_large(*largest, fields);
  return *largest;
}

std::vector<std::size_t> CdbGeneration::pattern(CommandFields& fields, bool selected,
                                                std::string_view command, bool elements) const {
  const std::vector<std::int64_t>& numbers =
      elements ? model_.mesh.cell_numbers : model_.mesh.node_numbers;
  const bool all = fields.peek() == "ALL";
  std::int64_t first = 1;
  std::int64_t last = kLargestNumber;
  std::int64_t step = 1;
  if (all) {
    if (selected)
      fields.refuse(fmt::format("{} of numbers, not of what NSEL or ESEL chose,", command));
    fields.skip(3);
  } else {
    first = fields.whole(fmt::format("{}: a number", command));
    last = fields.whole(fmt::format("{}: a number", command), first);
    step = fields.whole(fmt::format("{}: a step", command), 1);
    if (elements && first < 0) {
      // a negative number selects that many element numbers, up to the largest
      last = largest_element(fields);
      first = last + first + 1;
    }
  }
  if (step == 0) step = 1;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] >= first && numbers[i] <= last && (numbers[i] - first) % step == 0)
      places.push_back(i);
  std::stable_sort(places.begin(), places.end(),
                   [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
  // of entries with the same number, the last is kept
  std::size_t kept = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (i + 1 == places.size() || numbers[places[i]] != numbers[places[i + 1]])
      places[kept++] = places[i];
  places.resize(kept);
  if (places.empty()) fields.refuse(fmt::format("{} of what is there by then", command));
  return places;
}

/// NGEN, ITIME, INC, NODE1, NODE2, NINC, DX, DY, DZ, SPACE
void CdbGeneration::nodes(CommandFields& fields, bool selected, bool cartesian) {
  const std::int64_t times = fields.whole("NGEN: a number of times", 1);
  const std::int64_t increment = fields.whole("NGEN: an increment");
  const std::vector<std::size_t> from = pattern(fields, selected, "NGEN", false);
  std::array<double, 3> step{};
  for (double& x : step) x = fields.real();
  const double space = fields.at_end() ? 1 : fields.real();
  if (space != 1 && space != 0) fields.refuse("NGEN: a SPACE of 1");
  if (!cartesian) fields.refuse("NGEN: a system CSYS of 0");
  if (times < 2) return;
  take(fields, 4 * from.size());
  take(fields, 4 * from.size() * static_cast<std::size_t>(times - 1));
  ForeignMesh& mesh = model_.mesh;
  for (std::int64_t i = 1; i < times; ++i)
    for (const std::size_t place : from) {
      mesh.node_numbers.push_back(mesh.node_numbers[place] + i * increment);
      for (std::size_t c = 0; c < 3; ++c)
        mesh.xyz.push_back(mesh.xyz[3 * place + c] + static_cast<double>(i) * step[c]);
    }
}

/// EGEN, ITIME, NINC, IEL1, IEL2, IEINC, MINC, TINC, RINC, CINC, SINC, DX, DY, DZ: new elements get
/// the next free numbers.
void CdbGeneration::elements(CommandFields& fields, bool selected) {
  const std::int64_t times = fields.whole("EGEN: a number of times", 1);
  const std::int64_t increment = fields.whole("EGEN: an increment", 0);
  const std::vector<std::size_t> from = pattern(fields, selected, "EGEN", true);
  fields.skip(1);
  fields.require_zero("EGEN: a TINC of 0");
  fields.skip(3);
  for (int c = 0; c < 3; ++c) fields.require_zero("EGEN: a DX, DY and DZ of 0");
  if (times < 2) return;
  ForeignMesh& mesh = model_.mesh;
  std::vector<std::size_t> begins(mesh.cell_count() + 1);
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell)
    begins[cell + 1] = begins[cell] + mesh.types[mesh.cell_types[cell]].nodes;
  std::size_t numbers = 0;
  for (const std::size_t place : from) {
    numbers += 2 + begins[place + 1] - begins[place];
    for (std::size_t n = begins[place]; n < begins[place + 1]; ++n)
      if (mesh.cell_nodes[n] != kLeftOutNode) refuse_large(mesh.cell_nodes[n], fields);
  }
  take(fields, numbers);
  take(fields, numbers * static_cast<std::size_t>(times - 1));
  std::int64_t next = largest_element(fields);
  for (std::int64_t i = 1; i < times; ++i)
    for (const std::size_t place : from) {
      mesh.cell_numbers.push_back(++next);
      mesh.cell_types.push_back(mesh.cell_types[place]);
      for (std::size_t n = begins[place]; n < begins[place + 1]; ++n) {
        const std::int64_t node = mesh.cell_nodes[n];
        mesh.cell_nodes.push_back(node == kLeftOutNode ? node : node + i * increment);
      }
    }
}

}  // namespace hiac::formats::ansys
