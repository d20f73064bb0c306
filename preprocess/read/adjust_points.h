/// What users know of points beside what their file says.
#pragma once
#include "preprocess/points.h"

namespace splatray {

/// Scales the heights of points that no mesh has, with their normals and scanners, and has those whose scanner's place is not
/// known measured from ScanOptions::sensor_world.
void adjust_points(InputObject& object, const ScanOptions& options);

}  // namespace splatray
