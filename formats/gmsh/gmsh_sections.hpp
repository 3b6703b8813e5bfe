#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/common/io/input_text.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/gmsh/gmsh_stream.hpp"

namespace hiac::formats::gmsh {

/// The dimension and tag of an entity or a physical group.
using DimTag = std::pair<int, std::int64_t>;

/// A $NodeData, $ElementData or $ElementNodeData section: its head, and where its data begin.
struct DataSection {
  std::string name;
  FieldLocation location = FieldLocation::node;
  std::optional<double> time;  ///< none: the values hold at all times
  std::int64_t step = 0;
  std::size_t components = 1;
  std::size_t entities = 0;
  MshStream data;
};

/// The contents of the sections of an MSH file.
struct MshContents {
  double version = 0;
  ForeignMesh mesh;
  std::map<DimTag, std::string> physical_names;
  std::map<DimTag, std::vector<std::int64_t>> entity_groups;  ///< versions 3, 4
  std::map<DimTag, std::vector<IndexRange>> groups;           ///< cells of physical groups
  std::vector<DataSection> data;
};

/// Reads all sections except the data of fields, which are read later. The stream must outlive the
/// result.
MshContents read_sections(MshStream stream);

// These read the sections of the mesh; the stream is after the section's first line.
void read_nodes(MshStream& stream, MshContents& contents);
void read_parametric_nodes(MshStream& stream, MshContents& contents);
void read_elements(MshStream& stream, MshContents& contents);
void read_entities(MshStream& stream, MshContents& contents);
/// In version 3 this section is text in binary files too.
void read_entities_3(TextCursor& cursor, MshContents& contents);

}  // namespace hiac::formats::gmsh
