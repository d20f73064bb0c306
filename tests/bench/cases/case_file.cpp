#include "tests/bench/cases/case_file.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/file/atomic_file.h"

namespace splatray::testing {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

glm::dvec3 vector_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Camera camera_of(const Json& json) {
  Camera camera;
  camera.eye = vector_of(json.at("eye"));
  camera.target = vector_of(json.at("target"));
  camera.up = vector_of(json.at("up"));
  camera.fov_y_deg = json.at("fov_y_deg").get<double>();
  return camera;
}

PreparedCase case_of(const Json& json) {
  PreparedCase prepared;
  prepared.camera = camera_of(json.at("camera"));
  prepared.diagonal_world = json.at("diagonal_world").get<double>();
  prepared.truth = json.at("truth").get<std::string>();
  for (const auto& [file, variant] : json.at("variants").items()) {
    prepared.variants[file] = {variant.at("build_s").get<double>(), variant.at("overlap").get<double>(),
                               variant.at("radius_median_world").get<double>()};
  }
  return prepared;
}

}  // namespace

void write_case(const PreparedCase& prepared, const std::filesystem::path& folder) {
  const Camera& camera = prepared.camera;
  Json json{{"camera",
             {{"eye", json_of(camera.eye)},
              {"target", json_of(camera.target)},
              {"up", json_of(camera.up)},
              {"fov_y_deg", camera.fov_y_deg}}},
            {"diagonal_world", prepared.diagonal_world},
            {"truth", prepared.truth},
            {"variants", Json::object()}};
  for (const auto& [file, variant] : prepared.variants) {
    json["variants"][file] = {{"build_s", variant.build_s},
                              {"overlap", variant.overlap},
                              {"radius_median_world", variant.radius_median_world}};
  }
  write_text_file(json.dump(2) + '\n', folder / "case.json");
}

PreparedCase read_case(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "case.json";
  std::ifstream stream(path);
  try {
    return case_of(Json::parse(stream));
  } catch (const Json::exception& failure) {
    throw Error(ExitCode::input_unreadable,
                path.string() + ": found no case of splatray-bench prepare: " + failure.what());
  }
}

void write_environment(const Environment& environment, const std::filesystem::path& path) {
  AtomicFile file(path);
  const std::uint32_t size[2]{environment.width, environment.height};
  file.write(size, sizeof(size));
  file.write(&environment.constant, sizeof(glm::vec3));
  file.write(environment.texels.data(), environment.texels.size() * sizeof(glm::vec3));
  file.commit();
}

Environment read_environment_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::uint32_t size[2]{};
  Environment environment;
  stream.read(reinterpret_cast<char*>(size), sizeof(size));
  stream.read(reinterpret_cast<char*>(&environment.constant), sizeof(glm::vec3));
  environment.width = size[0];
  environment.height = size[1];
  if (stream) environment.texels.resize(std::size_t{size[0]} * size[1]);
  stream.read(reinterpret_cast<char*>(environment.texels.data()),
              static_cast<std::streamsize>(environment.texels.size() * sizeof(glm::vec3)));
  if (!stream)
    throw Error(ExitCode::input_unreadable, path.string() + ": found its end early, expected an environment");
  return environment;
}

}  // namespace splatray::testing
