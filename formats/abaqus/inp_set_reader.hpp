#pragma once

#include "formats/abaqus/inp_lines.hpp"
#include "formats/abaqus/inp_model.hpp"

namespace hiac::formats::abaqus {

/// *ELSET: adds its elements to the set of the part, or of the instance that it names. The sets of
/// an instance that does not exist are left out, with a note, because the mesh does not need them.
/// Throws InputError naming the line.
void read_element_set(const Keyword& keyword, TextCursor& cursor, Part& part, Model& model);

/// *NSET, of a part. Only keywords that generate nodes use node sets; they report what is not
/// understood here.
void read_node_set(const Keyword& keyword, TextCursor& cursor, Part& part);

}  // namespace hiac::formats::abaqus
