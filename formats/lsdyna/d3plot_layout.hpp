#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "formats/common/io/byte_stream.hpp"

namespace hiac::formats::lsdyna {

/// Words of 4 or 8 bytes, in either byte order: integers and reals.
class Words {
 public:
  /// Errors name `subject`.
  Words(std::string_view bytes, std::size_t word_bytes, std::endian order,
        const std::string& subject);

  [[nodiscard]] std::size_t size() const { return stream_.size() / word_bytes_; }
  [[nodiscard]] std::size_t word_bytes() const { return word_bytes_; }
  [[nodiscard]] std::endian order() const { return order_; }
  /// The word with that number. Throws InputError when it is past the end.
  [[nodiscard]] std::int64_t integer(std::size_t word);
  [[nodiscard]] double real(std::size_t word);
  [[noreturn]] void fail(const std::string& what) const { stream_.fail(what); }

 private:
  ByteStream stream_;
  std::size_t word_bytes_;
  std::endian order_;
};

/// The word size and byte order of a file, determined by its control words: they are those for
/// which the file's type and dimension are valid. Nothing when there are none.
struct WordKind {
  std::size_t bytes;
  std::endian order;
};
std::optional<WordKind> word_kind(std::string_view head);

/// The contents of the control words (LS-DYNA Database Manual, "State database"), and where data
/// begin.
struct Layout {
  std::size_t nodes = 0;
  std::size_t solids = 0;
  bool ten_nodes = false;        ///< solids have two more nodes, for tetrahedra
  std::size_t thick_shells = 0;  ///< bricks with values layer by layer
  std::size_t beams = 0;
  std::size_t shells = 0;
  std::size_t globals = 0;
  std::size_t temperatures = 0;  ///< words a node after the coordinates: temperature, flux, ...
  bool has_temperature = false;
  bool has_coordinates = false;
  bool has_velocity = false;
  bool has_acceleration = false;
  std::size_t thermal_values = 0;  ///< of a solid
  std::size_t solid_values = 0;    ///< of a solid: 6 stresses, plastic strain, history
  std::size_t deletion = 0;        ///< 0: none; 1: of nodes; 2: of elements
  // places of words in the first file; connectivity: solids and thick shells (9 words each), beams
  // (6), shells (5)
  std::size_t coordinates = 0;
  std::size_t connectivity = 0;
  std::size_t more_nodes = 0;
  std::size_t first_state = 0;
  // places in a state; data of nodes: coordinates, temperatures, velocity, acceleration
  std::size_t node_data = 0;
  std::size_t thermal_data = 0;
  std::size_t solid_data = 0;
  std::size_t deletion_data = 0;
  std::size_t state_words = 0;
};

/// Reads the control words and everything before the first state. Throws InputError naming data
/// that are not supported.
Layout read_layout(Words& words);

/// Marks the end of a file's states; it is in the place of a time.
inline constexpr double kEndMark = -999999.0;

}  // namespace hiac::formats::lsdyna
