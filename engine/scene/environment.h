/// Light from everywhere: a latitude-longitude picture or one constant radiance.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace splatray {

/// Latitude-longitude radiance, linear rgb. width == height == 0 means `constant` in every direction.
/// Frame: +y is up; the picture's centre looks along -z, columns to its right look towards +x, row 0 looks up.
struct Environment {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<glm::vec3> texels;  ///< rows from the top, width * height
  glm::vec3 constant{0.0F};       ///< radiance when there are no texels
};

/// Unit direction of the point (column_fraction, row_fraction), each 0..1 of the picture:
/// theta = pi row, phi = 2 pi (column - 1/2), direction = (sin theta sin phi, cos theta, -sin theta cos phi).
[[nodiscard]] glm::vec3 environment_direction(double column_fraction, double row_fraction);

/// Irradiance / pi in 9 spherical-harmonic coefficients, so that sum_i c_i P_i(n) is the radiance a white diffuse surface of
/// normal n sends out (Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps").
/// In the environment's own frame. Y_i in the order (l,m) = 00, 1-1, 10, 11, 2-2, 2-1, 20, 21, 22 with the polynomials
/// 1, y, z, x, xy, yz, 3z^2-1, xz, x^2-y^2; the constants of Y_i are folded into c_i.
[[nodiscard]] std::array<glm::vec3, 9> irradiance_coefficients(const Environment& environment);

/// The environment of pictures that name none: a soft bright studio, made by formula (128 x 64 texels).
[[nodiscard]] Environment studio_environment();

}  // namespace splatray
