/// glTF scenes, written by hand.
#include <cmath>
#include <cstring>

#include "tests/readers/read_error.h"

namespace splatray {
namespace {

std::string base64(const std::string& bytes) {
  static const char* const DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      word = word << 8U | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += i + j > bytes.size() ? '=' : DIGITS[word >> (18U - 6U * j) & 63U];
    }
  }
  return text;
}

/// A tetrahedron wound outwards, float positions then uchar indices: 48 + 12 bytes.
std::string tetrahedron_bytes() {
  std::string bytes;
  for (const float v : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F}) {
    bytes += bytes_of(v);
  }
  for (const int i : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) {
    bytes += static_cast<char>(i);
  }
  return bytes;
}

/// JSON around the tetrahedron: mesh 0 has material 0 when there are materials. `buffer` is the buffer's uri
/// member.
std::string scene_json(const std::string& nodes, const std::string& more, const std::string& primitive_more,
                       const std::string& buffer) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
         R"(],"meshes":[{"name":"tetra","primitives":[{"attributes":{"POSITION":0},"indices":1)" +
         primitive_more +
         R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5121,"count":12,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],)"
         R"("buffers":[{"byteLength":60)" +
         buffer + "}]" + more + "}";
}

std::string embedded(const std::string& nodes, const std::string& more = "",
                     const std::string& primitive = "") {
  return scene_json(nodes, more, primitive,
                    R"(,"uri":"data:application/octet-stream;base64,)" + base64(tetrahedron_bytes()) + "\"");
}

std::string glb(const std::string& nodes) {
  std::string json = scene_json(nodes, "", "", "");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string data = tetrahedron_bytes();
  const auto total = static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + data.size());
  return "glTF" + bytes_of(std::uint32_t{2}) + bytes_of(total) +
         bytes_of(static_cast<std::uint32_t>(json.size())) + "JSON" + json +
         bytes_of(static_cast<std::uint32_t>(data.size())) + std::string("BIN\0", 4) + data;
}

double signed_volume(const Mesh& mesh) {
  double volume = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const std::vector<glm::dvec3>& p = mesh.vertices.position;
    volume += glm::dot(p[t.x], glm::cross(p[t.y], p[t.z])) / 6.0;
  }
  return volume;
}

TEST(Gltf, NodeTransformsMultiplyAndMirrorsKeepTheOutside) {
  const TempFolder folder;
  const std::string nodes =
      R"({"children":[1],"translation":[10,0,0],"rotation":[0,0,0.70710678118654752,0.70710678118654752]},)"
      R"({"mesh":0,"scale":[-2,1,1],"name":"mirrored"})";
  const Input input = read_input({folder.write("t.gltf", embedded(nodes))}, keeping_meshes());
  ASSERT_EQ(input.objects.size(), 1U);
  EXPECT_EQ(input.objects[0].name, "mirrored");
  const Mesh& mesh = input.objects[0].meshes[0];
  EXPECT_NEAR(glm::distance(mesh.vertices.position[1], glm::dvec3(10.0, -2.0, 0.0)), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(mesh.vertices.position[2], glm::dvec3(9.0, 0.0, 0.0)), 0.0, 1e-12);
  EXPECT_NEAR(signed_volume(mesh), 2.0 / 6.0, 1e-9);
  EXPECT_TRUE(input.objects[0].oriented);
  const Points& points = input.objects[0].points;
  ASSERT_EQ(points.size(), 1000U);
  const glm::dvec3 center = (mesh.vertices.position[0] + mesh.vertices.position[1] +
                             mesh.vertices.position[2] + mesh.vertices.position[3]) /
                            4.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GT(glm::dot(points.position[i] - center, glm::dvec3(points.normal[i])), 0.0);
  }
}

TEST(Gltf, PointsPrimitivesAndVertexColours) {
  const TempFolder folder;
  const Input input = read_input(
      {folder.write("p.gltf",
                    embedded(R"({"mesh":0})",
                             R"(,"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,1],)"
                             R"("metallicFactor":0}}])",
                             R"(,"mode":0,"material":0)"))},
      {});
  EXPECT_EQ(input.objects[0].points.size(), 12U);  // the indices name twelve
  EXPECT_FLOAT_EQ(input.objects[0].material.phong.diffuse.y, 0.25F);
  EXPECT_EQ(input.objects[0].material.flags, 0U);
}

TEST(Gltf, VertexColoursBeyondTheirRangeAreCut) {
  const TempFolder folder;
  std::string bytes = tetrahedron_bytes();
  bytes.replace(0, 12, bytes_of(2.0F) + bytes_of(-1.0F) + bytes_of(NAN));
  std::string text = scene_json(R"({"mesh":0})", "", R"(,"mode":0)",
                                R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes) + "\"");
  text.replace(text.find(R"("POSITION":0)"), 12, R"("POSITION":0,"COLOR_0":0)");
  const Points points = read_input({folder.write("c.gltf", text)}, {}).objects[0].points;
  EXPECT_EQ(points.color.at(0), glm::vec3(1.0F, 0.0F, 0.0F));
  EXPECT_EQ(points.color.at(1), glm::vec3(0.0F, 1.0F, 0.0F));
}

TEST(Gltf, MaterialsBecomeGlassMirrorsAndPlastic) {
  const TempFolder folder;
  const auto material = [&](const std::string& json) {
    const std::string more = R"(,"materials":[)" + json + "]";
    return read_input({folder.write("m.gltf", embedded(R"({"mesh":0})", more, R"(,"material":0)"))},
                      keeping_meshes())
        .objects[0]
        .material;
  };
  const Material glass = material(
      R"({"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,1,1]},"extensions":{"KHR_materials_transmission":)"
      R"({"transmissionFactor":1},"KHR_materials_ior":{"ior":1.33},"KHR_materials_volume":{"thicknessFactor":2,)"
      R"("attenuationDistance":1,"attenuationColor":[0.25,1,1]}}})");
  EXPECT_EQ(glass.flags, MATERIAL_DIELECTRIC);
  EXPECT_FLOAT_EQ(glass.ior, 1.33F);
  EXPECT_FLOAT_EQ(glass.phong.tint.x, 0.25F);
  EXPECT_FLOAT_EQ(glass.phong.tint.y, 0.5F);
  const Material mirror = material(R"({"pbrMetallicRoughness":{"baseColorFactor":[0.9,0.8,0.7,1],)"
                                   R"("metallicFactor":1,"roughnessFactor":0.1}})");
  EXPECT_FLOAT_EQ(mirror.phong.mirror, 1.0F);
  EXPECT_FLOAT_EQ(mirror.phong.tint.z, 0.7F);
  const Material rough_metal = material(R"({"pbrMetallicRoughness":{"roughnessFactor":0.8}})");
  EXPECT_FLOAT_EQ(rough_metal.phong.mirror, 0.0F);
  EXPECT_FLOAT_EQ(rough_metal.phong.diffuse.x, 0.6F);
  const Material plastic =
      material(R"({"doubleSided":true,"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.5},)"
               R"("extras":{"mirror":0.25,"shininess":77}})");
  EXPECT_EQ(plastic.flags, MATERIAL_TWO_SIDED);
  EXPECT_FLOAT_EQ(plastic.phong.mirror, 0.25F);
  EXPECT_FLOAT_EQ(plastic.phong.shininess, 77.0F);
  EXPECT_NEAR(plastic.phong.specular, 0.105F, 1e-4F);
}

TEST(Gltf, AnyShareOfTransmissionIsKept) {
  const TempFolder folder;
  for (const std::string share : {"0.2", "0.5", "0.9"}) {
    const std::string more =
        R"(,"materials":[{"extensions":{"KHR_materials_transmission":{"transmissionFactor":)" + share +
        "}}}]";
    const Input input = read_input(
        {folder.write("t.gltf", embedded(R"({"mesh":0})", more, R"(,"material":0)"))}, keeping_meshes());
    EXPECT_EQ(input.objects[0].material.flags, MATERIAL_DIELECTRIC);
    EXPECT_FLOAT_EQ(input.objects[0].material.transmission, std::stof(share));
    EXPECT_EQ(input.objects[0].material.ior, 1.0F) << "a pane";
    EXPECT_EQ(input.objects[0].material.coat, 1.0F) << "which mirrors as glass does";
    EXPECT_EQ(input.objects[0].material.coat_roughness, input.objects[0].material.roughness);
  }
}

TEST(Gltf, NumbersOutOfRangeAreNotedAndTheNearestTaken) {
  const TempFolder folder;
  const auto read = [&](const std::string& material) {
    return read_input({folder.write("n.gltf", embedded(R"({"mesh":0})", R"(,"materials":[)" + material + "]",
                                                       R"(,"material":0)"))},
                      keeping_meshes());
  };
  const Input odd = read(
      R"({"name":"odd","pbrMetallicRoughness":{"roughnessFactor":-3},"emissiveFactor":[1,1,1],"extensions":{)"
      R"("KHR_materials_ior":{"ior":0.5},"KHR_materials_emissive_strength":{"emissiveStrength":1e38}}})");
  EXPECT_EQ(odd.objects[0].material.roughness, 0.0F);
  EXPECT_EQ(odd.objects[0].material.layer_ior, 1.0F);
  EXPECT_EQ(odd.objects[0].material.emission, glm::vec3(1e9F));
  EXPECT_TRUE(
      has_note(odd, "material odd: roughnessFactor: found -3, expected 0 to 1; the nearest is taken"));
  EXPECT_TRUE(has_note(odd, "ior: found 0.5, expected 1 or more"));
  EXPECT_TRUE(has_note(odd, "emissiveStrength: found 1e+38, expected 0 to"));
  EXPECT_FALSE(has_note(read(R"({"pbrMetallicRoughness":{"roughnessFactor":1}})"), "expected"));
}

TEST(Gltf, WhatIsBlendedAllOverHasItsOpacity) {
  const TempFolder folder;
  const std::string veil =
      R"(,"materials":[{"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.25]}}])";
  const Input input = read_input(
      {folder.write("v.gltf", embedded(R"({"mesh":0})", veil, R"(,"material":0)"))}, keeping_meshes());
  EXPECT_EQ(input.objects[0].material.flags, 0U);
  const Column* opacity = find_column(input.objects[0].points.columns, "texture-opacity");
  ASSERT_NE(opacity, nullptr);
  for (std::size_t i = 0; i < opacity->size(); ++i) EXPECT_EQ(opacity->number(i), 64.0);
  EXPECT_TRUE(input.notes.empty() || input.notes.back().find("alphaMode") == std::string::npos);
}

TEST(Gltf, DielectricsWoundInwardsAreTurned) {
  const TempFolder folder;
  std::string bytes = tetrahedron_bytes();
  for (std::size_t i = 48; i < 60; i += 3) {
    std::swap(bytes[i + 1], bytes[i + 2]);
  }
  const auto read = [&](const std::string& extension) {
    const std::string json = scene_json(
        R"({"mesh":0})", R"(,"materials":[{"extensions":{)" + extension + "}}]", R"(,"material":0)",
        R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes) + "\"");
    return read_input({folder.write("w.gltf", json)}, keeping_meshes());
  };
  const Input glass = read(R"("KHR_materials_transmission":{"transmissionFactor":1})");
  EXPECT_GT(signed_volume(glass.objects[0].meshes[0]), 0.0);
  EXPECT_TRUE(glass.objects[0].oriented);
  EXPECT_TRUE(has_note(glass, "turned outwards"));
  const Input metal = read("");
  EXPECT_LT(signed_volume(metal.objects[0].meshes[0]), 0.0);
  EXPECT_FALSE(metal.objects[0].oriented);
}

TEST(Gltf, CamerasAndLights) {
  const TempFolder folder;
  const std::string more =
      R"(,"cameras":[{"type":"orthographic","orthographic":{"xmag":1,"ymag":2,"zfar":9,"znear":0.1}},)"
      R"({"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}}],"extensionsUsed":["KHR_lights_punctual"],)"
      R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional","intensity":3,"color":[1,0.5,0]},)"
      R"({"type":"spot","intensity":5,"range":9,"spot":{"innerConeAngle":0.125,"outerConeAngle":0.5}}]}})";
  const std::string nodes =
      R"({"mesh":0,"children":[1,2,3]},{"camera":0,"translation":[0,0,5]},)"
      R"({"rotation":[-0.70710678118654752,0,0,0.70710678118654752],"extensions":{"KHR_lights_punctual":{"light":0}}},)"
      R"({"translation":[1,2,3],"camera":1,"extensions":{"KHR_lights_punctual":{"light":1}}})";
  const Input input = read_input({folder.write("c.gltf", embedded(nodes, more))}, keeping_meshes());
  ASSERT_TRUE(input.camera);
  EXPECT_DOUBLE_EQ(input.camera->ortho_height, 4.0);
  EXPECT_DOUBLE_EQ(input.camera->eye.z, 5.0);
  EXPECT_LT(input.camera->target.z, 1.0);
  EXPECT_NEAR(input.camera->up.y, 1.0, 1e-12);
  EXPECT_TRUE(has_note(input, "first of 2 cameras"));
  ASSERT_EQ(input.lights.size(), 2U);
  EXPECT_EQ(input.lights[0].kind, LIGHT_DIRECTIONAL);
  EXPECT_NEAR(input.lights[0].position.y, 1.0, 1e-7);
  EXPECT_FLOAT_EQ(input.lights[0].power.y, 1.5F);
  EXPECT_EQ(input.lights[1].kind, LIGHT_POINT);
  EXPECT_DOUBLE_EQ(input.lights[1].position.z, 3.0);
  EXPECT_EQ(input.lights[1].spot_axis, glm::dvec3(0.0, 0.0, -1.0));
  EXPECT_EQ(input.lights[1].spot_inner, 0.125);
  EXPECT_EQ(input.lights[1].spot_outer, 0.5);
  EXPECT_EQ(input.lights[1].range, 9.0);
}

TEST(Gltf, LightsHaveTheSizesOfExtras) {
  const TempFolder folder;
  const std::string more =
      R"(,"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point",)"
      R"("intensity":12},{"type":"directional","intensity":3}]}})";
  const auto light = [](const std::string& index, const std::string& extras) {
    return R"({"translation":[1,2,3],"rotation":[-0.70710678118654752,0,0,0.70710678118654752],)"
           R"("extensions":{"KHR_lights_punctual":{"light":)" +
           index + R"(}},"extras":{)" + extras + "}}";
  };
  const std::string nodes = R"({"mesh":0,"children":[1,2,3]},)" + light("0", R"("size":0.25)") + "," +
                            light("1", R"("size":0.53)") + "," + light("0", R"("width":3,"height":2)");
  const Input input = read_input({folder.write("c.gltf", embedded(nodes, more))}, keeping_meshes());
  ASSERT_EQ(input.lights.size(), 3U);
  EXPECT_EQ(input.lights[0].size, 0.25);
  EXPECT_NEAR(input.lights[1].size, 0.53 * M_PI / 360.0, 1e-12);
  const SceneLight& rectangle = input.lights[2];
  EXPECT_EQ(rectangle.kind, LIGHT_RECTANGLE);
  EXPECT_EQ(rectangle.position, glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_FLOAT_EQ(rectangle.power.x, 2.0F) << "12 candela of 6 square metres";
  EXPECT_NEAR(glm::length(rectangle.edge_u - glm::dvec3(1.5, 0.0, 0.0)), 0.0, 1e-7);
  const glm::dvec3 area = glm::cross(2.0 * rectangle.edge_u, 2.0 * rectangle.edge_v);
  EXPECT_NEAR(glm::length(area - glm::dvec3(0.0, -6.0, 0.0)), 0.0, 1e-6) << "down, the node's -z";
}

const char* const TWO_POINTS =
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float "
    "z\nend_header\n"
    "0 0 0\n1 2 3\n";

TEST(Gltf, ExtrasPointsAreFoundBesideTheSceneOrOnADataPath) {
  const TempFolder folder;
  const TempFolder data;
  const std::string nodes = R"({"translation":[0,0,1],"scale":[2,2,2],"extras":{"points":"models/two.ply"}})";
  const std::filesystem::path scene = folder.write("e.gltf", embedded(nodes));
  data.write("two.ply", TWO_POINTS);
  ReadOptions options;
  options.data_paths = {data.path()};
  EXPECT_DOUBLE_EQ(read_input({scene}, options).objects[0].points.position[1].z, 7.0);
  folder.write("models/two.ply", TWO_POINTS);
  EXPECT_EQ(read_input({scene}, {}).objects[0].points.size(), 2U);
}

TEST(Gltf, MissingPointsSayWhereToGetThem) {
  const TempFolder folder;
  const std::string nodes =
      R"({"name":"hero","extras":{"points":"models/hero.ply","source":"get it from the museum"}})";
  ReadOptions options;
  options.data_paths = {"/nonexistent-data"};
  const std::string sentence = read_error(folder.write("e.gltf", embedded(nodes)), options);
  for (const char* part :
       {"points of node 'hero'", "models/hero.ply", "/nonexistent-data/hero.ply", "museum"}) {
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  }
}

TEST(Gltf, TruncationAtEveryByteIsAnErrorOrAValidInput) {
  const TempFolder folder;
  read_every_prefix(folder, "t.glb", glb(R"({"mesh":0})"));
  read_every_prefix(folder, "t.gltf", embedded(R"({"mesh":0})"));
}

TEST(Gltf, EveryCorruptByteIsAnErrorOrAValidInput) {
  const TempFolder folder;
  const std::string good = glb(R"({"mesh":0})");
  ReadOptions few;
  few.samples = 50;
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const int flip : {0x01, 0x0A, 0x90}) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ flip);
      const std::filesystem::path file = folder.write("c.glb", bad);
      try {
        static_cast<void>(read_input({file}, few));
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_unreadable) << error.what();
      }
    }
  }
}

TEST(Gltf, AccessorsBeyondTheirBufferAreErrors) {
  const TempFolder folder;
  const auto edited = [&](const std::string& from, const std::string& to) {
    std::string text = embedded(R"({"mesh":0})");
    text.replace(text.find(from), from.size(), to);
    return read_error(folder.write("b.gltf", text));
  };
  EXPECT_NE(edited(R"("count":4,)", R"("count":5,)").find("too short for 5 elements"), std::string::npos);
  EXPECT_NE(edited(R"("count":12)", R"("count":2000000000)").find("too short"), std::string::npos);
  EXPECT_NE(edited(R"("byteOffset":48)", R"("byteOffset":49)").find("buffer view 1 ends at byte 61"),
            std::string::npos);
  EXPECT_NE(edited(R"("indices":1)", R"("indices":9)").find("not a readable glTF"), std::string::npos);
  EXPECT_NE(edited(R"("nodes":[0])", R"("nodes":[3])").find("node 3"), std::string::npos);
}

TEST(Gltf, AMissingBufferIsNamed) {
  const TempFolder folder;
  const std::string text =
      R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"parts/a b.bin"}]})";
  EXPECT_NE(read_error(folder.write("m.gltf", text)).find("found no file 'parts/a b.bin'"),
            std::string::npos);
}

TEST(Gltf, RequiredExtensionsThatAreUnknownAreErrorsUsedOnesNotes) {
  const TempFolder folder;
  const auto scene = [&](const std::string& more) {
    return folder.write("x.gltf", embedded(R"({"mesh":0})", more));
  };
  EXPECT_NE(read_error(scene(R"(,"extensionsRequired":["EXT_strange"])")).find("EXT_strange"),
            std::string::npos);
  EXPECT_NE(read_error(scene(R"(,"extensionsRequired":["KHR_draco_mesh_compression"])")).find("compressed"),
            std::string::npos);
  EXPECT_TRUE(
      has_note(read_input({scene(R"(,"extensionsUsed":["EXT_strange"])")}, keeping_meshes()), "EXT_strange"));
}

TEST(Gltf, WhatTheFileSaysDoesNotBreakTheLine) {
  const TempFolder folder;
  const auto scene = [&](const std::string& more) {
    return folder.write("l.gltf", embedded(R"({"mesh":0})", more));
  };
  EXPECT_NE(read_error(scene(R"(,"extensionsRequired":["EXT\n\u001b[2J"])")).find("EXT??[2J"),
            std::string::npos);
  EXPECT_TRUE(
      has_note(read_input({scene(R"(,"extensionsUsed":["EXT\n\u001b[2J"])")}, keeping_meshes()), "EXT??[2J"));
}

TEST(Gltf, ABufferThatIsAFolderIsAnError) {
  const TempFolder folder;
  const std::string text = scene_json(R"({"mesh":0})", "", "", R"(,"uri":".")");
  EXPECT_NE(read_error(folder.write("d.gltf", text)).find("found no file '"), std::string::npos);
}

TEST(Gltf, CyclesOfNodesAreErrors) {
  const TempFolder folder;
  const std::string nodes = R"({"children":[1]},{"children":[0]})";
  EXPECT_NE(read_error(folder.write("y.gltf", embedded(nodes))).find("more than one parent"),
            std::string::npos);
}

TEST(Gltf, SparsePositionsReplaceTheirBase) {
  const TempFolder folder;
  std::string text = embedded(R"({"mesh":0})");
  const std::string data =
      bytes_of(std::uint16_t{3}) + std::string(2, '\0') + bytes_of(0.0F) + bytes_of(0.0F) + bytes_of(8.0F);
  text.replace(
      text.find(R"("count":4,)"), 10,
      R"("sparse":{"count":1,"indices":{"bufferView":2,"componentType":5123},"values":{"bufferView":3}},)"
      R"("count":4,)");
  text.replace(text.find(R"({"buffer":0,"byteOffset":48)"), 0,
               R"({"buffer":0,"byteOffset":48,"byteLength":12},{"buffer":1,"byteLength":2},)"
               R"({"buffer":1,"byteOffset":4,"byteLength":12},)");
  text.insert(text.rfind("]}"),
              R"(,{"byteLength":16,"uri":"data:application/octet-stream;base64,)" + base64(data) + "\"}");
  const Input input = read_input({folder.write("s.gltf", text)}, keeping_meshes());
  EXPECT_DOUBLE_EQ(input.objects[0].meshes[0].vertices.position[3].z, 8.0);
}

}  // namespace
}  // namespace splatray
