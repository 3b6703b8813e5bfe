#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/calculix/frd_records.hpp"
#include "formats/common/io/input_text.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::frd {

/// A result block: its values, and where they begin.
struct ResultBlock {
  std::string name;
  std::size_t components = 0;
  std::size_t records = 0;  ///< of binary blocks
  Encoding encoding{};
  std::size_t offset = 0;
};

/// The result blocks of a file ("100CL") and their steps.
class Results {
 public:
  /// Reads the head of a block, whose first line, at `start`, the cursor has passed, and its
  /// components (-4, -5), and skips its values: `count` records if they are binary. A new step is
  /// added to the mesh's times. Throws InputError naming the line.
  void read(TextCursor& cursor, std::string_view line, std::size_t start, std::size_t count,
            Encoding encoding, std::vector<double>& times);

  /// Adds a field for every block, whose values are read on request from the text, which the fields
  /// share. A note tells of values for nodes that the mesh does not have; they are left out.
  void add_to(ForeignMesh& mesh, const std::shared_ptr<InputText>& text) const;

 private:
  std::size_t step_of(double time, std::int64_t number, const std::string& name,
                      std::vector<double>& times);

  std::vector<std::pair<std::size_t, ResultBlock>> blocks_;  ///< with their steps
  std::vector<std::pair<double, std::int64_t>> steps_;
  std::set<std::pair<std::size_t, std::string>> seen_;
};

}  // namespace hiac::formats::frd
