/// Reading can be watched, ended, and kept to a number of threads; closed meshes can be turned outwards.
#include <tbb/global_control.h>

#include <algorithm>
#include <tuple>

#include "tests/readers/las_file.h"
#include "tests/readers/read_error.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

/// Triangles of a square of `edge` by `edge` vertices, in each format that is written easily.
std::string grid_obj(int edge) {
  std::string text;
  for (int i = 0; i < edge * edge; ++i)
    text += "v " + std::to_string(i % edge) + " " + std::to_string(i / edge) + " 0\n";
  for (int i = 0; i + edge + 1 < edge * edge; ++i)
    text += "f " + std::to_string(i + 1) + " " + std::to_string(i + 2) + " " + std::to_string(i + edge + 1) +
            "\n";
  return text;
}

std::string grid_ply(int edge) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(edge * edge) +
                     "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (int i = 0; i < edge * edge; ++i)
    text += std::to_string(i % edge) + " " + std::to_string(i / edge) + " 0.123456789\n";
  return text;
}

std::string grid_stl(std::uint32_t count) {
  std::string bytes = std::string(80, ' ') + bytes_of(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i);
    for (const float v : {0.0F, 0.0F, 1.0F, x, 0.0F, 0.0F, x + 1.0F, 0.0F, 0.0F, x, 1.0F, 0.0F})
      bytes += bytes_of(v);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string grid_vtp(int count) {
  std::string numbers;
  for (int i = 0; i < count; ++i) numbers += std::to_string(i) + " 1 2 ";
  return "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\"><PolyData><Piece "
         "NumberOfPoints=\"" +
         std::to_string(count) +
         "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
         "NumberOfPolys=\"0\"><Points><DataArray "
         "type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">" +
         numbers + "</DataArray></Points></Piece></PolyData></VTKFile>\n";
}

TEST(ReadProgress, AscendsAndEveryReaderStopsWhenAsked) {
  const TempFolder folder;
  const std::string ply = grid_ply(700);
  const std::vector<std::filesystem::path> files = {
      folder.write("a.ply", ply), folder.write("a.obj", grid_obj(400)),
      folder.write("a.stl", grid_stl(120000)), folder.write("a.vtp", grid_vtp(200000)),
      folder.write("a.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],
                               "nodes":[{"extras":{"points":"a.ply"}}]})")};
  for (const std::filesystem::path& file : files) {
    std::vector<double> shares;
    ReadOptions options;
    options.progress = [&](const std::string& stage, double share) {
      if (stage == "reading") shares.push_back(share);
      return true;
    };
    (void)read_input({file}, options);
    ASSERT_GE(shares.size(), 4U) << file;
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end())) << file;
    EXPECT_GE(shares.front(), 0.0);
    EXPECT_LE(shares.back(), 1.0);
    std::size_t calls = 0;
    options.progress = [&](const char*, double) { return ++calls < shares.size() / 2; };
    try {
      (void)read_input({file}, options);
      ADD_FAILURE() << file << " was read to its end";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::interrupted) << error.what();
    }
    EXPECT_EQ(calls, shares.size() / 2) << file;
  }
}

/// Every point of scans and of a mesh's vertices, once and in order, LAS block by block.
TEST(ReadPoints, AreShownOnceAsTheyAreRead) {
  const TempFolder folder;
  LasFile las;
  for (int i = 0; i < 100'000; ++i) {
    las.records.emplace_back().position[0] = i;
  }
  for (const auto& [name, bytes, calls] :
       {std::tuple{"a.las", las.bytes(), std::size_t{2}}, std::tuple{"b.ply", grid_ply(20), std::size_t{1}},
        std::tuple{"c.obj", grid_obj(20), std::size_t{1}}}) {
    std::vector<glm::dvec3> seen;
    std::size_t times = 0;
    ReadOptions options;
    const bool measured =
        std::string(name) != "c.obj";  // not in the closure: Clang 14 takes no bindings there
    options.points = [&](const SeenPoints& points) {
      EXPECT_EQ(points.first, seen.size());
      EXPECT_EQ(points.measured, measured);
      seen.insert(seen.end(), points.points.position.begin() + static_cast<std::ptrdiff_t>(points.first),
                  points.points.position.end());
      ++times;
    };
    const Input input = read_input({folder.write(name, bytes)}, options);
    if (!measured) {
      EXPECT_EQ(seen.size(), 400U) << "its vertices";
    } else {
      EXPECT_TRUE(seen == input.objects[0].points.position) << name;
    }
    EXPECT_GE(times, calls) << name;
  }
}

TEST(ReadThreads, AreLimitedWhileReading) {
  const TempFolder folder;
  using Control = tbb::global_control;
  const std::size_t all = Control::active_value(Control::max_allowed_parallelism);
  std::size_t seen = 0;
  ReadOptions options;
  options.threads = 1;
  options.progress = [&](const char*, double) {
    seen = std::max(seen, Control::active_value(Control::max_allowed_parallelism));
    return true;
  };
  (void)read_input({folder.write("a.obj", grid_obj(20))}, options);
  EXPECT_EQ(seen, 1U);
  EXPECT_EQ(Control::active_value(Control::max_allowed_parallelism), all);
}

TEST(TurnOutwards, TurnsAClosedMeshWithoutADielectric) {
  const TempFolder folder;
  const auto inwards =
      folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  const auto outward_share = [&](bool turn) {
    ReadOptions options;
    options.samples = 500;
    options.turn_outwards = turn;
    const Points points = read_input({inwards}, options).objects[0].points;
    double outward = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      outward += glm::dot(points.position[i] - 0.25, glm::dvec3(points.normal[i])) > 0.0 ? 1.0 : 0.0;
    return outward / static_cast<double>(points.size());
  };
  EXPECT_EQ(outward_share(false), 0.0);
  EXPECT_EQ(outward_share(true), 1.0);
}

}  // namespace
}  // namespace splatray
