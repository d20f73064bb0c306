/// What the guard builds: inputs made from a seed, with what is true of them.
#pragma once
#include <filesystem>

namespace splatray::testing {

/// A mesh's vertices as points: FOLDER/bare.ply and, with its vertices' normals, FOLDER/normals.ply; views of it all around as
/// FOLDER/front.json (+z), back.json (-z) and oblique.json. Those no triangle uses are left out. Throws Error as read_input does.
void write_model_inputs(const std::filesystem::path& mesh, const std::filesystem::path& folder);

/// Ten range images of a mesh joined, as raw scans are: noise of 0.15 of the points' spacing, views moved by 0.3 of it, mixed pixels
/// at edges; FOLDER/normals.ply with the normals of each view's grid and bare.ply without. An empty path: of body_mesh, which is
/// written as FOLDER/mesh.ply.
void write_raw_scan(const std::filesystem::path& mesh, const std::filesystem::path& folder);

/// A room from two places and hills from the air: FOLDER/room.ptx, room_bare.ply, with their truth beside them.
void write_room(const std::filesystem::path& folder);

/// A wall of 3 x 2 m on a floor from one or two stations, 4 m before and behind it, 10 mm apart with a noise of 2.5 mm, for each
/// thickness: FOLDER/wall_THICKNESS_STATIONS.ptx with truth, mesh wall_THICKNESS.ply; millimetres.
void write_walls(const std::filesystem::path& folder);

/// A scan thinned to 1, 1/2, 1/5 and 1/10 of its points at random: FOLDER/1.las to 10.las.
void write_thinned(const std::filesystem::path& scan, const std::filesystem::path& folder);

/// The truth of a scan whose colours are normals ((n + 1) / 2), as its scanner's software saw them: write_point_truth. Points whose
/// colours are none count as leaves, whose normals are not judged.
void write_truth_of_colors(const std::filesystem::path& scan, const std::filesystem::path& folder);

/// A scan's points without their normals, as PLY.
void write_bare(const std::filesystem::path& scan, const std::filesystem::path& path);

}  // namespace splatray::testing
