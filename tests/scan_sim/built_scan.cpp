#include "tests/scan_sim/built_scan.h"

#include <numeric>

namespace splatray::testing {

BuiltScan build_scan(const Points& points, const BuildParams& params, unsigned threads,
                     const std::optional<glm::dvec3>& up) {
  Input input;
  input.up = up;
  InputObject& object = input.objects.emplace_back();
  object.material = default_material();
  object.points = points;
  std::vector<double> numbers(points.size());
  std::iota(numbers.begin(), numbers.end(), 0.0);
  object.points.columns.push_back({std::string(POINT_NUMBER), numbers});
  BuiltScan built;
  built.scene = build_scene(std::move(input), params, threads, built.stats);
  return built;
}

std::size_t number_of(const Scene& scene, std::size_t splat) {
  return static_cast<std::size_t>(find_column(scene.columns, POINT_NUMBER)->number(splat));
}

}  // namespace splatray::testing
