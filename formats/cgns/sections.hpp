#pragma once

#include <cstddef>
#include <cstdint>

#include "formats/cgns/cgns_file.hpp"
#include "formats/cgns/zone.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::cgns {

/// Appends the elements of an unstructured zone to `mesh`, which has the zone's points from
/// `first_point` on, section by section in the order of their element numbers: the order of cell
/// data. Sets zone.numbers from the element numbers. Throws InputError naming the file and the
/// section.
void add_sections(const CgnsFile& file, std::size_t first_point, Zone& zone, ForeignMesh& mesh);

/// The cell count of a zone may exclude surface elements, and solutions then have one value for
/// each of the counted cells. If sections of surfaces precede or lie between those of volumes,
/// element numbers are not places among these values, and volume cells are numbered
/// consecutively.
void number_volumes(const ForeignMesh& mesh, std::size_t first_cell, Zone& zone);

}  // namespace hiac::formats::cgns
