/// Variable length records of LAS files (ASPRS, LAS Specification 1.4 R15, sections 2.5 and 2.7), those that readers need.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/las/las_header.h"

namespace splatray {

struct LasVlrs {
  std::vector<unsigned char> laszip;       ///< how points are compressed; empty = no such record
  std::vector<unsigned char> extra_bytes;  ///< descriptors of all records of this kind, one after another
  std::vector<unsigned char> geo_keys;     ///< GeoTIFF's directory of keys
  std::vector<unsigned char> copc_info;    ///< where the octree of a COPC file is
  std::string wkt;                         ///< the coordinate system as text
};

/// Reads the records between header and points, and those behind the points. What claims to reach further than there are
/// bytes ends the list, as do the points: counts of records are often wrong.
[[nodiscard]] LasVlrs read_las_vlrs(ByteReader& in, const LasHeader& header);

}  // namespace splatray
