#pragma once

#include <cstdint>
#include <string>

#include "formats/foreign_mesh.hpp"

namespace hiac::formats {

/// The place of the type with that name and number of nodes in `mesh.types`, where it is added when
/// it is not there yet. Throws InputError when there are 65536 already.
std::uint16_t type_index(ForeignMesh& mesh, const std::string& name, std::size_t nodes,
                         const CellConversion& conversion);

/// A conversion to `kind`.
constexpr CellConversion converted_to(CellKind kind,
                                      std::span<const std::uint8_t> permutation = {}) {
  return {CellFate::converted, kind, permutation, std::nullopt, false};
}
/// A volume cell that the zoo has no kind for; its corners make `corners`.
constexpr CellConversion unsupported_with(CellKind corners,
                                          std::span<const std::uint8_t> permutation = {}) {
  return {CellFate::unsupported, {}, permutation, corners, false};
}
inline constexpr CellConversion kUnsupported{CellFate::unsupported, {}, {}, std::nullopt, false};
inline constexpr CellConversion kNoVolume{CellFate::no_volume, {}, {}, std::nullopt, false};
inline constexpr CellConversion kWrongCount{CellFate::wrong, {}, {}, std::nullopt, false};

}  // namespace hiac::formats
