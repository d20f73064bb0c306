/// Names in Latin-1, as programs of Windows and old ones write them, come out of every reader as UTF-8.
#include "engine/base/utf8.h"
#include "tests/readers/e57/read_bytes.h"
#include "tests/readers/las_file.h"
#include "tests/readers/scan_reading.h"

namespace splatray {
namespace {

const std::string LATIN_1 = "H\xF6he";
const std::string UTF_8 = "H\xC3\xB6he";

ReadOptions keeping(const std::string& attribute) {
  ReadOptions options;
  options.scans.attributes = {attribute};
  return options;
}

/// Expects a column of that name, which is asked for in UTF-8, as a command line gives it.
void expect_column(const std::filesystem::path& file) {
  const Input input = read_input({file}, keeping(UTF_8));
  const auto& columns = input.objects.at(0).points.columns;
  EXPECT_NE(find_column(columns, UTF_8), nullptr) << file;
  for (const std::string& note : input.notes) EXPECT_TRUE(is_utf8(note)) << note;
}

TEST(Encoding, NamesOfAttributes) {
  const TempFolder folder;
  expect_column(folder.write("a.csv", "x,y,z," + LATIN_1 + "\n0,0,0,1\n1,0,0,2\n0,1,0,3\n"));
  expect_column(folder.write("a.pcd", "FIELDS x y z " + LATIN_1 +
                                          "\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\n"
                                          "POINTS 2\nDATA ascii\n0 0 0 1\n1 0 0 2\n"));
  expect_column(
      folder.write("a.ply", "ply\nformat ascii 1.0\ncomment " + LATIN_1 +
                                "\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                                "property float " +
                                LATIN_1 + "\nend_header\n0 0 0 1\n1 0 0 2\n"));
  expect_column(folder.write(
      "a.vtk",
      "# vtk DataFile Version 3.0\na title\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 1 1 0\n"
      "POLYGONS 1 4\n3 0 1 2\nPOINT_DATA 3\nSCALARS " +
          LATIN_1 + " float 1\nLOOKUP_TABLE default\n1 2 3\n"));
}

TEST(Encoding, TextsOfLas) {
  LasFile file;
  file.records = {las_point(0, 0, 0), las_point(1000, 0, 0), las_point(0, 1000, 0)};
  std::string descriptor(192, '\0');
  descriptor[2] = 1;
  descriptor.replace(4, LATIN_1.size(), LATIN_1);
  file.vlrs = {las_vlr("LASF_Spec", 4, descriptor),
               las_vlr("LASF_Projection", 2112, "PROJCS[\"" + LATIN_1 + "\",UNIT[\"metre\",1]]")};
  file.extra_bytes = 1;
  for (LasRecord& record : file.records) record.extra = "\1";
  std::string bytes = file.bytes();
  bytes.replace(58, LATIN_1.size(), LATIN_1);  // the software
  const TempFolder folder;
  const auto path = folder.write("a.las", bytes);
  expect_column(path);
  EXPECT_EQ(read_input({path}, {}).crs, "PROJCS[\"" + UTF_8 + "\",UNIT[\"metre\",1]]");
  for (const FileFact& fact : read_scan(path).file.facts) EXPECT_TRUE(is_utf8(fact.text)) << fact.name;
}

/// Also where a character lies across two chunks of the XML, of 65536 bytes, and whatever the XML calls its encoding.
TEST(Encoding, TextsOfE57) {
  for (const std::string& name : {LATIN_1, UTF_8})
    for (const std::string encoding :
         {"", " encoding=\"UTF-8\"", " encoding=\"ISO-8859-1\"", " encoding=\"x\""})
      for (int shift = 0; shift < 3; ++shift) {
        testing::E57TestScan scan = testing::line_scan(3);
        scan.xml = "<name type=\"String\">" + name + "</name><!--" + std::string(std::size_t(shift), ' ');
        for (int i = 0; i < 50000; ++i) scan.xml += "\xC3\xA4\xE4";
        scan.xml += "-->";
        testing::E57TestFile file{{scan}};
        file.prolog = "<?xml version=\"1.0\"" + encoding + "?>";
        file.elements = "<coordinateMetadata type=\"String\">" + name + "</coordinateMetadata>";
        const Points points = testing::read_bytes(testing::e57_bytes(file)).points;
        EXPECT_EQ(points.stations.at(0).name, UTF_8);
        EXPECT_EQ(points.crs, UTF_8);
      }
}

/// A scene of a triangle whose node has that name; `binary`: as a GLB.
std::string gltf_named(const std::string& name, bool binary) {
  const std::string triangle = bytes_of(0.0F) + bytes_of(0.0F) + bytes_of(0.0F) + bytes_of(1.0F) +
                               bytes_of(0.0F) + bytes_of(0.0F) + bytes_of(0.0F) + bytes_of(1.0F) +
                               bytes_of(0.0F);
  std::string json = R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":")" +
                     name + R"("}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{)" +
                     (binary ? "" : R"("uri":"a.bin",)") +
                     R"("byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","max":[1,1,0],"min":[0,0,0]}]})";
  if (!binary) return json;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto size = [](std::size_t bytes) { return bytes_of(static_cast<std::uint32_t>(bytes)); };
  return "glTF" + bytes_of(2U) + size(12 + 8 + json.size() + 8 + 36) + size(json.size()) + "JSON" + json +
         size(36) + std::string("BIN\0", 4) + triangle;
}

TEST(Encoding, NamesOfGltf) {
  const TempFolder folder;
  folder.write("a.bin", gltf_named("", true).substr(gltf_named("", true).size() - 36));
  for (const std::string& name : {LATIN_1, UTF_8, LATIN_1 + "x", LATIN_1 + LATIN_1}) {
    EXPECT_EQ(
        read_input({folder.write("a.gltf", gltf_named(name, false))}, keeping_meshes()).objects.at(0).name,
        to_utf8(name));
    EXPECT_EQ(
        read_input({folder.write("a.glb", gltf_named(name, true))}, keeping_meshes()).objects.at(0).name,
        to_utf8(name));
  }
}

TEST(Encoding, NamesOfFiles) {
  const TempFolder folder;
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  const auto file = folder.write(LATIN_1 + ".xyz", points), other = folder.write("b.xyz", points);
  EXPECT_EQ(read_input({file}, {}).objects.at(0).name, UTF_8);
  EXPECT_EQ(read_input({file, other}, {}).objects.at(0).points.stations.at(0).name, UTF_8);
  const auto ply =
      folder.write(LATIN_1 + ".ply",
                   "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                   "property float z\nend_header\n0 0 0\n");
  EXPECT_EQ(read_input({ply}, {}).objects.at(0).name, UTF_8);
  try {
    (void)read_input({folder.path() / ("missing" + LATIN_1 + ".xyz")}, {});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("missing" + UTF_8), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace splatray
