/// What stands for points that are not read: means of those that lie together.
#pragma once
#include <span>
#include <vector>

#include "preprocess/base/level_lattice.h"
#include "preprocess/read/tiles/tile_schema.h"

namespace splatray {

/// Means of records, one for those in each of the cells of a level, in Morton order of the cells, which must be less than 2^20 from each
/// other. Where surfaces end, meet or change their colour, one for those in each eighth of the cell. Of records under tile_means_schema each
/// counts as often as it says. Position, intensity and normal are means (normals that
/// cancel are zero: to be estimated), the colour is that of the mean light, the class the most frequent one, all else that of the record
/// nearest to the mean. Points that are left out when a scan is read, noise and withheld ones, have means of their own.
/// Appends them to `means`, under tile_means_schema. The level is less than LevelLattice::BITS.
void append_means(std::span<const unsigned char> records, const TileSchema& schema,
                  const LevelLattice& lattice, unsigned level, std::vector<unsigned char>& means);

}  // namespace splatray
