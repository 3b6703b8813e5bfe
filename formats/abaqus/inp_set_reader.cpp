#include "formats/abaqus/inp_set_reader.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "formats/common/io/comma_fields.hpp"
#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::abaqus {
namespace {

/// First, last and step; none when the fields are not a range.
std::optional<NumberRange> generated(CommaFields& fields) {
  const auto first = fields.integer();
  const auto last = fields.integer();
  const auto step = fields.at_end() ? std::optional<std::int64_t>(1) : fields.integer();
  if (!first || !last || !step || *step < 1 || *last < *first || *first < 0) return std::nullopt;
  return NumberRange{*first, *last, *step};
}

/// The members that the data lines of one keyword add to a set.
struct Members {
  std::vector<NumberRange> ranges;
  std::set<std::string> names;  ///< of sets whose ranges are among them
  std::size_t copied = 0;       ///< how many these are
};

/// Adds a number, or the members of the set with that name; false when that set is not defined
/// yet.
bool add_member(std::string_view member, const NumberSets& known, Members& members) {
  if (const auto number = to_integer(member)) {
    add_number(*number, members.ranges);
    return true;
  }
  const auto set = known.find(upper(member));
  if (set == known.end() || !set->second.unknown.empty()) return false;
  if (!members.names.insert(set->first).second) return true;
  const std::vector<NumberRange>& ranges = set->second.ranges;
  members.ranges.insert(members.ranges.end(), ranges.begin(), ranges.end());
  members.copied += ranges.size();
  return true;
}

}  // namespace

void read_element_set(const Keyword& keyword, TextCursor& cursor, Part& part, Model& model) {
  const std::string name = required(keyword, "ELSET", cursor);
  NumberSets of_nothing;  // the sets of an instance that does not exist
  NumberSets* sets = &part.sets;
  if (const std::string* instance = keyword.value("INSTANCE")) {
    const auto found =
        std::find_if(model.instances.begin(), model.instances.end(),
                     [&](const Instance& i) { return upper(i.name) == upper(*instance); });
    // the mesh does not need the sets of an instance that does not exist
    if (found == model.instances.end())
      model.notes.push_back(
          fmt::format("left out a set of elements of instance {}, which there "
                      "is not",
                      shown(*instance)));
    sets = found == model.instances.end() ? &of_nothing : &found->sets;
  }
  const bool generate = keyword.has_flag("GENERATE");
  Members elements;
  while (const auto line = data_line(cursor)) {
    CommaFields fields(*line);
    if (generate) {
      const auto range = generated(fields);
      if (!range) refuse(cursor, *line, "first, last and step of a range");
      elements.ranges.push_back(*range);
      continue;
    }
    while (!fields.at_end()) {
      // a name that is not an element set names nodes or a surface
      static_cast<void>(add_member(fields.field(), *sets, elements));
    }
  }
  add_ranges(elements.ranges, set_named(*sets, name), elements.copied);
}

void read_node_set(const Keyword& keyword, TextCursor& cursor, Part& part) {
  const std::string* name = keyword.value("NSET");
  if (name == nullptr || name->empty() || keyword.has("INSTANCE")) return;
  NumberSets& sets = part.node_sets;
  Members nodes;
  std::string unknown;
  if (keyword.has("ELSET")) unknown = "those of a set of elements";
  while (const auto line = data_line(cursor)) {
    CommaFields fields(*line);
    if (keyword.has_flag("GENERATE")) {
      const auto range = generated(fields);
      if (range)
        nodes.ranges.push_back(*range);
      else
        unknown = shown(*line);
      continue;
    }
    while (!fields.at_end()) {
      const std::string_view member = fields.field();
      if (!member.empty() && !add_member(member, sets, nodes)) unknown = shown(member);
    }
  }
  const bool made = !sets.contains(upper(*name));
  NumberSet& set = set_named(sets, *name);
  if (made) set.unsorted = keyword.has_flag("UNSORTED");
  if (!unknown.empty()) set.unknown = unknown;
  add_ranges(nodes.ranges, set, nodes.copied);
}

}  // namespace hiac::formats::abaqus
