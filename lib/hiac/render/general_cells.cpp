#include "hiac/render/general_cells.hpp"
namespace hiac {
void render_general_cells(const Frame&, std::span<const CellId>, const TileRect&, TileBuffer&,
                          SegmentList*, TileCounts&) {}
}  // namespace hiac
