#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/common/io/input_text.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::unv {

/// The head of a dataset of results, and where its values begin.
struct UnvResult {
  std::string name;
  FieldLocation location = FieldLocation::node;
  std::int64_t step = 0;  ///< its number when it has no time
  double time = 0;
  std::size_t values = 0;  ///< a tuple's, in the file
  bool symmetric = false;  ///< a symmetric tensor: xx, xy, yy, xz, yz, zz
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Reads the head of dataset 55 (data at nodes) or 2414 (analysis data); the cursor is after the
/// dataset's number, `end` is the offset of its last line. None, with a note, when its values are
/// of a kind that is not supported.
std::optional<UnvResult> read_result_head(TextCursor cursor, std::int64_t dataset, std::size_t end,
                                          std::vector<std::string>& notes);

/// Adds fields and times to the mesh.
void add_results(std::vector<UnvResult>&& results, const std::shared_ptr<InputText>& text,
                 ForeignMesh& mesh);

}  // namespace hiac::formats::unv
