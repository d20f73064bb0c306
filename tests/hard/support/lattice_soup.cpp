#include "tests/hard/support/lattice_soup.h"

#include <cmath>

#include "tests/hard/support/clouds.h"

namespace splatray::testing {

using glm::dvec3;

Scene lattice_soup(std::uint32_t leaf_size) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> cell(4, 28);
  std::uniform_real_distribution<double> exponent(15.0,
                                                  16.9);  // 2^17 would end windows exactly on other planes
  std::vector<Disc> discs;
  for (int i = 0; i < 1500; ++i) {
    dvec3 normal = random_unit(random);
    if (i % 3 == 0) {
      normal = dvec3(0.0);
      normal[i / 3 % 3] = i % 2 == 0 ? 1.0 : -1.0;
    }
    const dvec3 center(cell(random), cell(random), cell(random));
    discs.push_back({65536.0 * center, normal, std::exp2(exponent(random))});
  }
  return lattice_scene(discs, test_material(MATERIAL_TWO_SIDED), leaf_size);
}

dvec3 lattice_point(std::mt19937_64& random) {
  const int power = static_cast<int>(random() % 21);
  const std::int64_t steps = std::int64_t{1} << (LATTICE_BITS - static_cast<unsigned>(power));
  std::uniform_int_distribution<std::int64_t> step(-steps / 4, steps + steps / 4);
  const dvec3 point(double(step(random)), double(step(random)), double(step(random)));
  return point * std::exp2(power);
}

}  // namespace splatray::testing
