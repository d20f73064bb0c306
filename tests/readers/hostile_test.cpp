/// Files made to harm: each is refused in one sentence with its name, before memory or stack run out.
#include <sys/resource.h>

#include "tests/readers/read_error.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

std::string nested(std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); }

/// Expects a refusal that holds `words`, and no more than 64 MiB of memory touched beyond what was before.
void expect_cheap_refusal(const std::filesystem::path& file, const std::string& words) {
  const auto peak_kib = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const long before = peak_kib();
  EXPECT_NE(read_error(file).find(words), std::string::npos) << read_error(file);
  EXPECT_LT(peak_kib() - before, 64L << 10);
}

TEST(Hostile, PlyVerticesWithoutProperties) {
  const TempFolder folder;
  expect_cheap_refusal(folder.write("a.ply",
                                    "ply\nformat ascii 1.0\nelement vertex 3\nelement face 1\n"
                                    "property list uchar int vertex_indices\nend_header\n3 0 1 2\n"),
                       "no properties x, y, z");
}

TEST(Hostile, DeepJsonOfGltf) {
  const TempFolder folder;
  const auto json = [](std::size_t depth) {
    return R"({"asset":{"version":"2.0"},"extras":)" + nested(depth) + "}";
  };
  expect_cheap_refusal(folder.write("deep.gltf", json(200000)), "nests more than 64 deep");
  expect_cheap_refusal(folder.write("at.gltf", json(64)), "nests more than 64 deep");
  expect_cheap_refusal(folder.write("below.gltf", json(63)), "found no points");
  const std::string text = json(200000);
  const auto size = static_cast<std::uint32_t>(text.size());
  expect_cheap_refusal(
      folder.write("deep.glb", "glTF" + bytes_of(2U) + bytes_of(size + 20U) + bytes_of(size) + "JSON" + text),
      "nests more than 64 deep");
}

TEST(Hostile, BracketsInStringsAreNotDepth) {
  const TempFolder folder;
  const std::string text = R"({"asset":{"version":"2.0","generator":"\")" + std::string(100, '[') + R"("}})";
  expect_cheap_refusal(folder.write("text.gltf", text), "found no points");
}

/// A PNG's signature and header; nothing follows.
std::string png_header(std::uint32_t edge) {
  const std::string side = {static_cast<char>(edge >> 24U), static_cast<char>(edge >> 16U),
                            static_cast<char>(edge >> 8U), static_cast<char>(edge)};
  return "\x89PNG\r\n\x1a\n" + std::string("\0\0\0\rIHDR", 8) + side + side + std::string("\x08\2\0\0\0", 5);
}

TEST(Hostile, TexturesOfMorePixelsThanTheFileHoldsAreRefused) {
  const TempFolder folder;
  const std::string bytes(36, '\0');
  folder.write("b.bin", bytes);
  const auto scene = [&](std::uint32_t edge) {
    folder.write("t.png", png_header(edge));
    return folder.write("t.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
      "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],
      "images":[{"uri":"t.png"}],"buffers":[{"uri":"b.bin","byteLength":36}],
      "bufferViews":[{"buffer":0,"byteLength":36}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}]})");
  };
  expect_cheap_refusal(scene(12000), "144000000 pixels in 29 bytes");
  EXPECT_TRUE(has_note(read_input({scene(4096)}, {}), "cannot be decoded"));
}

/// A VTP of one piece; `more` stands in VTKFile's tag, `arrays` in the piece.
std::string vtp(const std::string& more, const std::string& points, const std::string& arrays,
                const std::string& appended = "") {
  return "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\"" + more +
         "><PolyData><Piece NumberOfPoints=\"" + points +
         "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">" + arrays +
         "</Piece></PolyData>" + appended + "</VTKFile>\n";
}

std::string points_array(const std::string& format, const std::string& content) {
  return "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"" + format + "\">" + content +
         "</DataArray></Points>";
}

TEST(Hostile, VtpCountsBeyondTheFile) {
  const TempFolder folder;
  expect_cheap_refusal(folder.write("a.vtp", vtp("", "100000000000000", points_array("ascii", "0 0 0"))),
                       "NumberOfPoints 100000000000000");
  expect_cheap_refusal(folder.write("b.vtp", vtp("", "100000000", points_array("ascii", "0 0 0"))),
                       "NumberOfPoints 100000000");
  expect_cheap_refusal(folder.write("c.vtp", vtp("", "-1", points_array("ascii", "0 0 0"))),
                       "expected a whole number");
  std::string wide = vtp("", "2", points_array("ascii", "0 0 0 1 1 1"));
  wide.replace(wide.find("Components=\"3\""), 14, "Components=\"2000000000\"");
  expect_cheap_refusal(folder.write("d.vtp", wide), "NumberOfComponents 2000000000");
}

TEST(Hostile, VtpCompressedBlocksBeyondTheFile) {
  const TempFolder folder;
  const std::string compressor = " header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"";
  // base64 of the words 2^40, 2^20, 0 and of 1, 2^40, 0
  expect_cheap_refusal(
      folder.write("a.vtp", vtp(compressor, "2", points_array("binary", "AAAAAAABAAAAABAAAAAAAAAAAAAAAAAA"))),
      "1099511627776 compressed blocks");
  expect_cheap_refusal(
      folder.write("b.vtp", vtp(compressor, "2", points_array("binary", "AQAAAAAAAAAAAAAAAAEAAAAAAAAAAAAA"))),
      "1 compressed blocks of 1099511627776 bytes");
}

TEST(Hostile, VtpCompressedBlocksOfNothing) {
  const TempFolder folder;
  // base64 of the words 1, 0, 36: VTK divides by the second
  expect_cheap_refusal(folder.write("a.vtp", vtp(" compressor=\"vtkZLibDataCompressor\"", "3",
                                                 points_array("binary", "AQAAAAAAAAAkAAAA"))),
                       "1 compressed blocks of 0 bytes");
}

TEST(Hostile, VtpAppendedArraysBeyondTheFile) {
  const TempFolder folder;
  const std::string array =
      "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"appended\" "
      "offset=\"0\"/></Points>";
  const auto appended = [](const std::string& bytes) {
    return "<AppendedData encoding=\"raw\">_" + bytes + "</AppendedData>";
  };
  const std::string data = bytes_of(24U) + std::string(24, '\0');
  EXPECT_EQ(read_input({folder.write("good.vtp", vtp("", "2", array, appended(data)))}, {})
                .objects[0]
                .points.size(),
            2U);
  const std::string forged = bytes_of(0xFFFFFFF0U) + std::string(24, '\0');
  expect_cheap_refusal(folder.write("a.vtp", vtp("", "2", array, appended(forged))),
                       "array of 4294967280 bytes");
  std::string far = array;
  far.replace(far.find("offset=\"0\""), 10, "offset=\"123456789\"");
  expect_cheap_refusal(folder.write("b.vtp", vtp("", "2", far, appended(data))), "offset 123456789");
}

TEST(Hostile, DeepXmlOfVtp) {
  const TempFolder folder;
  std::string deep;
  for (int i = 0; i < 200000; ++i) deep += "<a>";
  expect_cheap_refusal(folder.write("a.vtp", vtp("", "2", deep)), "nest more than 64 deep");
  expect_cheap_refusal(folder.write("b.vtp", "<!DOCTYPE a [<!ENTITY b \"c\">]>" + vtp("", "2", "")),
                       "without document types");
}

/// A scene of one triangle whose node's points and whose buffer have these names.
std::string scene_of(const std::string& buffer, const std::string& extras) {
  return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" + extras +
         R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"uri":")" + buffer +
         R"(","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}]})";
}

TEST(Hostile, NamesThatLeaveTheScenesFolder) {
  const TempFolder folder;
  const std::string triangle = bytes_of(0.0F) + bytes_of(0.0F) + bytes_of(0.0F) + bytes_of(1.0F) +
                               bytes_of(0.0F) + bytes_of(0.0F) + bytes_of(0.0F) + bytes_of(1.0F) +
                               bytes_of(0.0F);
  folder.write("outside.bin", triangle);
  folder.write("scenes/parts/inside.bin", triangle);
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "end_header\n1 2 3\n";
  const std::string absolute = folder.write("outside.ply", ply).string();
  folder.write("scenes/inside.ply", ply);
  const auto write = [&](const std::string& buffer, const std::string& extras = "") {
    return folder.write("scenes/s.gltf", scene_of(buffer, extras));
  };
  const std::string inside = "parts/../parts/inside.bin";
  EXPECT_EQ(read_input({write(inside)}, keeping_meshes()).objects.size(), 1U);
  for (const char* uri : {"../outside.bin", "%2e%2e/outside.bin", "parts/../../outside.bin"})
    expect_cheap_refusal(write(uri), "expected a file in the scene's folder or below");
  EXPECT_EQ(read_input({write(inside, R"(,"extras":{"points":"inside.ply"})")}, {}).objects[0].points.size(),
            1U);
  for (const std::string& name : {std::string("../outside.ply"), absolute})
    expect_cheap_refusal(write(inside, R"(,"extras":{"points":")" + name + R"("})"),
                         "expected a file in the scene's folder or in a data path");
}

TEST(Hostile, TrianglesWithVerticesBeyondAllUseAreDropped) {
  const TempFolder folder;
  const auto ply = folder.write(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1e200 0\n"
      "3 0 1 2\n3 0 2 3\n");
  ReadOptions options;
  options.samples = 50;
  const Input input = read_input({ply}, options);
  EXPECT_TRUE(has_note(input, "dropped 1 triangles with vertices that are not finite or beyond 1e100"));
  EXPECT_NEAR(input.objects.at(0).surface_area, 0.5, 1e-12);
}

}  // namespace
}  // namespace splatray
