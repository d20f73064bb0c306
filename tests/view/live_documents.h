/// A document of a scene small enough to trace in no time.
#pragma once
#include <string>

#include <memory>

#include "app/view/model/document_request.h"
#include "app/view/thread/live_scene.h"
#include "engine/base/number_text.h"
#include "tests/gpu/small_scene.h"

namespace splatray {

/// The discs of tests/gpu/small_scene.h.
inline SharedScene shared_discs(std::uint32_t count = 2) {
  return std::make_shared<const Scene>(disc_scene(count));
}

/// Shows them before a white environment.
inline Document disc_document(const Scene& scene) {
  Document document;
  document.loaded =
      std::make_shared<const LoadedPart>(LoadedPart{{}, {}, {}, scene.object_names, scene.materials});
  document.materials = document.loaded->materials;
  document.request.look.style = LOOK_PAPER;
  document.request.look.tone = Tone::neutral;
  document.request.look.lights = requested_lights(scene.lights);
  document.request.look.environment = "white";
  document.camera = disc_view(1, 1).camera;
  document.request.settings.samples = 3;
  document.request.look.up = scene.up;
  document.bounds_min_world = scene.bounds_min_world;
  document.bounds_max_world = scene.bounds_max_world;
  return document;
}

/// A triangle of 1 x 1 under a lamp of its own.
inline std::string lamp_gltf(double candela) {
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],"scene":0,"scenes":[{"nodes":[0,1]}],
"nodes":[{"mesh":0},{"translation":[0.3,0.3,1.5],"extensions":{"KHR_lights_punctual":{"light":0}}}],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":)" +
         number_text(candela) + R"(}]}},
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"materials":[{"doubleSided":true,
"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.4,0.3,1],"metallicFactor":0,"roughnessFactor":0.8}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,
"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

/// A cube of one material, open or a room around the camera.
inline std::string cube_obj() {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += "v " + std::to_string(i & 1) + " " + std::to_string(i >> 1 & 1) + " " +
            std::to_string(i >> 2 & 1) + "\n";
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

}  // namespace splatray
