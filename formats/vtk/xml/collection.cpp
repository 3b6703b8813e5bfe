#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "formats/common/io/bytes_behind.hpp"
#include "formats/common/io/mapped_file.hpp"
#include "formats/common/io/named_file.hpp"
#include "formats/common/mesh/block_choice.hpp"
#include "formats/common/mesh/field_steps.hpp"
#include "formats/common/mesh/gate.hpp"
#include "formats/common/mesh/steps.hpp"
#include "formats/common/pieces/complete_fields.hpp"
#include "formats/common/pieces/merge_pieces.hpp"
#include "formats/common/pieces/piece_field.hpp"
#include "formats/registry.hpp"
#include "formats/vtk/reading_process.hpp"
#include "formats/vtk/vtk_formats.hpp"
#include "formats/vtk/xml/vtk_xml.hpp"
#include "formats/vtk/xml/xml_layout.hpp"
#include "formats/vtk/xml/xml_text.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

/// The types of files that are trees of blocks.
constexpr std::array<std::string_view, 3> kTrees{
    "vtkMultiBlockDataSet", "vtkPartitionedDataSetCollection", "vtkPartitionedDataSet"};

/// A file that another file names: a block, or a part of a step.
struct Member {
  std::string path;
  std::vector<std::string> names;  ///< its own name and those of the enclosing blocks
};

bool is_tree(std::string_view type) {
  return std::find(kTrees.begin(), kTrees.end(), type) != kTrees.end();
}

/// Surfaces and tables: datasets that contain no volume cell.
bool holds_no_volume(std::string_view type) {
  return type == "PolyData" || type == "PPolyData" || type == "Table" || type == "PTable";
}

/// The contents of the member files, some of which contain no volume cells.
class Members {
 public:
  Members(std::vector<Member>&& members, const ReadOptions& options, std::string subject)
      : members_(std::move(members)), options_(options), subject_(std::move(subject)) {
    for (const Member& member : members_)
      for (const std::string& name : member.names)
        if (std::find(names_.begin(), names_.end(), name) == names_.end()) names_.push_back(name);
    choose_block();
    sort_out_surfaces();
  }

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  Reading read() const {
    const auto process = vtk::reading_process();  // one for all members
    std::vector<Reading> pieces;
    ReadOptions options = options_;
    options.block.reset();
    options.time.reset();
    options.step.reset();
    for (const Member& member : members_) {
      pieces.push_back(read_member(member, options));
      // one dataset may be in pieces itself, as a parallel run's at one step
      if (PieceMarking::is_on() && members_.size() > 1)
        mark_piece(pieces.back().mesh, pieces.size() - 1);
    }
    complete_fields(pieces, subject_);
    Reading reading = merge_pieces(std::move(pieces), subject_);
    reading.notes.insert(reading.notes.end(), notes_.begin(), notes_.end());
    finish_reading(reading, subject_);
    return reading;
  }

  [[nodiscard]] Inventory inspect() const {
    const auto process = vtk::reading_process();
    Inventory all;
    for (const Member& member : members_) add_piece(all, format_of(member).inspect(member.path));
    all.blocks = names_;
    all.notes = notes_;
    return all;
  }

 private:
  void choose_block() {
    if (!options_.block) return;
    if (std::find(names_.begin(), names_.end(), *options_.block) == names_.end())
      throw no_such_block(*options_.block, names_, subject_);
    std::erase_if(members_, [&](const Member& member) {
      return std::find(member.names.begin(), member.names.end(), *options_.block) ==
             member.names.end();
    });
  }

  void sort_out_surfaces() {
    std::size_t surfaces = 0;
    std::erase_if(members_, [&](const Member& member) {
      const std::string type = vtk::xml_file_type(file_head(member.path));
      surfaces += holds_no_volume(type) ? 1 : 0;
      return holds_no_volume(type);
    });
    if (surfaces > 0)
      notes_.push_back(fmt::format("left out {} files of surfaces or tables", surfaces));
  }

  /// The format of a member. A member must not be a list of files of the same kind, otherwise files
  /// could name each other.
  [[nodiscard]] const Format& format_of(const Member& member) const {
    const std::string own = vtk::xml_file_type(file_head(subject_));
    const std::string type = vtk::xml_file_type(file_head(member.path));
    if (type == "Collection" || (is_tree(own) && is_tree(type)))
      throw InputError(subject_, fmt::format("names {}, which is itself a list of files (a dataset "
                                             "expected)",
                                             member.path));
    return format_to_read(member.path);
  }

  [[nodiscard]] Reading read_member(const Member& member, const ReadOptions& options) const {
    // a dataset may be empty or contain only surfaces
    const vtk::XmlReader reader = vtk::xml_reader(vtk::xml_file_type(file_head(member.path)));
    Reading reading = reader.read ? reader.read(member.path, options)
                                  : format_of(member).read(member.path, options);
    std::erase_if(reading.mesh.metadata, [](const auto& entry) { return entry.first == "source"; });
    return reading;
  }

  std::vector<Member> members_;
  ReadOptions options_;
  std::string subject_;
  std::vector<std::string> names_;
  std::vector<std::string> notes_;
};

// ---- .pvd

struct TimedMember {
  double time;
  Member member;
};

std::vector<TimedMember> collection(const std::string& path) {
  const MappedFile file(path);
  const vtk::XmlText text(file.text(), "Collection", path);
  std::vector<TimedMember> members;
  for (const pugi::xml_node element : text.primary().children("DataSet")) {
    const std::string named = element.attribute("file").as_string();
    if (named.empty()) text.fail("a DataSet without a file");
    const std::string_view time_text = element.attribute("timestep").as_string("0");
    double time = 0;
    const auto [end, error] =
        std::from_chars(time_text.data(), time_text.data() + time_text.size(), time);
    if (error != std::errc() || end != time_text.data() + time_text.size() || !std::isfinite(time))
      text.fail(fmt::format("a DataSet with a wrong timestep (a number expected, '{}' found)",
                            time_text));
    TimedMember member{time, {file_beside(path, named), {}}};
    for (const char* name : {"group", "name"})
      if (const std::string value = element.attribute(name).as_string(); !value.empty())
        member.member.names.push_back(value);
    members.push_back(std::move(member));
  }
  if (members.empty()) text.fail("names no files");
  return members;
}

std::vector<double> times_of(const std::vector<TimedMember>& members) {
  std::vector<double> times;
  for (const TimedMember& member : members) times.push_back(member.time);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// The names of the arrays on points and cells that a dataset's file declares. The data of inline
/// arrays are passed over, not parsed.
void add_array_names(std::string_view xml, std::set<std::string>& names) {
  xml = xml.substr(0, xml.find("<AppendedData"));
  constexpr std::string_view kName = " Name=\"";
  for (const std::string_view section : {"PointData", "CellData"}) {
    for (std::size_t at = xml.find(section); at != std::string_view::npos;
         at = xml.find(section, at)) {
      at += section.size();
      const std::size_t tag_end = xml.find('>', at);
      if (tag_end == std::string_view::npos) break;
      if (xml[tag_end - 1] == '/') continue;
      const std::size_t end = std::min(xml.find(section, tag_end), xml.size());
      const std::string_view body = xml.substr(tag_end, end - tag_end);
      for (std::size_t name = body.find(kName); name != std::string_view::npos;
           name = body.find(kName, name)) {
        name += kName.size();
        names.emplace(body.substr(name, body.find('"', name) - name));
      }
      at = std::min(end + section.size(), xml.size());
    }
  }
}

/// The steps at which every array is in one of the files.
FieldSteps field_steps(const std::vector<TimedMember>& members, const std::vector<double>& times) {
  FieldSteps steps;
  for (const TimedMember& member : members) {
    std::set<std::string> names;
    add_array_names(MappedFile(member.member.path).text(), names);
    const auto step = std::lower_bound(times.begin(), times.end(), member.time) - times.begin();
    for (const std::string& name : names) steps[name].insert(static_cast<std::size_t>(step));
  }
  return steps;
}

std::vector<Member> members_at(std::vector<TimedMember>&& all, double time) {
  std::vector<Member> members;
  for (TimedMember& member : all)
    if (member.time == time) members.push_back(std::move(member.member));
  return members;
}

Reading read_collection(const std::string& path, const ReadOptions& options) {
  std::vector<TimedMember> all = collection(path);
  const std::vector<double> times = times_of(all);
  const auto step = requested_step(options, times, path);
  const double time = times[step.value_or(times.size() - 1)];
  Reading reading = Members(members_at(std::move(all), time), options, path).read();
  std::erase_if(reading.mesh.metadata, [](const auto& entry) { return entry.first == "time"; });
  reading.mesh.metadata.emplace_back("time", fmt::format("{}", time));
  if (!step && times.size() > 1) reading.notes.push_back(last_step_note(times.size(), time));
  note_behind_root(MappedFile(path).text(), "VTKFile", reading.notes);
  return reading;
}

Inventory inspect_collection(const std::string& path) {
  std::vector<TimedMember> all = collection(path);
  const std::vector<double> times = times_of(all);
  const FieldSteps steps = field_steps(all, times);
  Inventory inventory = Members(members_at(std::move(all), times.back()), {}, path).inspect();
  inventory.format = "pvd";
  note_partial_fields(steps, times.size(), inventory.notes);
  note_behind_root(MappedFile(path).text(), "VTKFile", inventory.notes);
  inventory.times = times;
  return inventory;
}

// ---- .vtm and its relatives

void add_members(pugi::xml_node parent, const std::vector<std::string>& names,
                 const std::string& path, std::vector<Member>& members) {
  for (const pugi::xml_node element : parent.children()) {
    const std::string_view kind = element.name();
    std::vector<std::string> own = names;
    if (const std::string name = element.attribute("name").as_string(); !name.empty())
      own.push_back(name);
    const std::string named = element.attribute("file").as_string();
    if ((kind == "DataSet" || kind == "Piece") && !named.empty())
      members.push_back({file_beside(path, named), std::move(own)});
    else if (kind == "Block" || kind == "Piece" || kind == "Partitions")
      add_members(element, own, path, members);
  }
}

std::vector<Member> tree(const std::string& path) {
  const MappedFile file(path);
  const vtk::XmlText text(file.text(), vtk::xml_file_type(file_head(path)), path);
  std::vector<Member> members;
  add_members(text.primary(), {}, path, members);
  if (members.empty()) text.fail("names no files");
  return members;
}

}  // namespace

Format pvd_format() {
  Format format;
  format.name = "pvd";
  format.extensions = {".pvd"};
  format.kinds = "those of the files that it names";
  format.fields = "node, cell";
  format.time_steps = "several";
  format.recognizes = [](std::string_view head) {
    return vtk::xml_file_type(head) == "Collection";
  };
  format.read = read_collection;
  format.inspect = inspect_collection;
  return format;
}

Format vtm_format() {
  Format format;
  format.name = "vtm";
  format.extensions = {".vtm", ".vtmb", ".vtpc", ".vtpd"};
  format.kinds = "those of the files that it names";
  format.fields = "node, cell";
  format.time_steps = "one";
  format.recognizes = [](std::string_view head) { return is_tree(vtk::xml_file_type(head)); };
  format.read = [](const std::string& path, const ReadOptions& options) {
    // only the named files can state a time
    if (options.step.value_or(0) > 0 || options.time)
      throw UsageError(fmt::format("{}: {} holds one step", options.time ? "time" : "step", path));
    return Members(tree(path), options, path).read();
  };
  format.inspect = [](const std::string& path) {
    Inventory inventory = Members(tree(path), {}, path).inspect();
    inventory.format = "vtm";
    return inventory;
  };
  return format;
}

}  // namespace hiac::formats
