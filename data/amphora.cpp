#include "data/amphora.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "data/scanner.h"

namespace splatray {
namespace {

using std::numbers::pi;

/// A number of [0, 1) of a place of the integer lattice (Jarzynski and Olano 2020, pcg).
double hash(glm::ivec3 place, std::uint32_t salt = 0) {
  std::uint32_t word = salt;
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t state = (word + static_cast<std::uint32_t>(place[axis])) * 747796405U + 2891336453U;
    const std::uint32_t mixed = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
    word = (mixed >> 22U) ^ mixed;
  }
  return word * 0x1p-32;
}

/// Numbers of the unit lattice, joined smoothly (value noise, Perlin 1985): 0 to 1.
double noise(glm::dvec3 p) {
  const glm::dvec3 floor = glm::floor(p);
  const glm::dvec3 t = glm::smoothstep(glm::dvec3(0.0), glm::dvec3(1.0), p - floor);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::dvec3 weight = glm::mix(1.0 - t, t, glm::dvec3(at));
    sum += weight.x * weight.y * weight.z * hash(glm::ivec3(floor) + at);
  }
  return sum;
}

/// Three octaves of it, 0 to 1.
double rough_noise(glm::dvec3 p) {
  return (4.0 * noise(p) + 2.0 * noise(2.1 * p + 7.0) + noise(4.3 * p + 13.0)) / 7.0;
}

/// The sherd that holds a place, and how far inside it that is, m (cells of Worley 1996).
struct Sherd {
  double shade = 0.0;  ///< 0 to 1
  double depth = 0.0;
};

Sherd sherd(glm::dvec3 position) {
  constexpr double SIZE = 0.3;
  const glm::dvec3 p = position / SIZE;
  const glm::ivec3 cell(glm::floor(p));
  Sherd found;
  double nearest = 1e9;
  double second = 1e9;
  for (int i = 0; i < 27; ++i) {
    const glm::ivec3 at = cell + glm::ivec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const double distance =
        glm::distance(p, glm::dvec3(at) + glm::dvec3(hash(at, 1), hash(at, 2), hash(at, 3)));
    second = std::min(second, std::max(nearest, distance));
    if (distance < nearest) found.shade = hash(at, 4);
    nearest = std::min(nearest, distance);
  }
  found.depth = 0.5 * SIZE * (second - nearest);
  return found;
}

/// What a band shows: whether there is glaze at (u, v) of one repeat, u around and v upwards, both 0 to 1.
using Motif = bool (*)(double u, double v);

bool solid(double, double) { return true; }

bool zigzag(double u, double v) { return std::abs(v - 0.22 - 0.56 * std::abs(2.0 * u - 1.0)) < 0.17; }

bool rays(double u, double v) { return v < 1.0 - 2.4 * std::abs(u - 0.5); }

bool tongues(double u, double v) {
  const double across = std::abs(u - 0.5);
  return v > 0.35 ? across < 0.36 : across * across / 0.13 + (v - 0.35) * (v - 0.35) / 0.1225 < 1.0;
}

/// Circles within circles, one as high as the band; a repeat is 1.15 times as wide as high.
bool circles(double u, double v) {
  const double radius = std::hypot(1.15 * (u - 0.5), v - 0.5);
  return radius < 0.07 || std::abs(radius - 0.2) < 0.045 || std::abs(radius - 0.42) < 0.06;
}

bool meander(double u, double v) {
  constexpr std::array<std::string_view, 9> KEY{"........", "#######.", "#.....#.", "#.###.#.", "#.#...#.",
                                                "#.#####.", "#.......", "########", "........"};
  return KEY[std::min<std::size_t>(8, static_cast<std::size_t>(9.0 * (1.0 - v)))]
            [std::min<std::size_t>(7, static_cast<std::size_t>(8.0 * u))] == '#';
}

/// From y = low to high, m, `repeats` times around.
struct Band {
  double low, high;
  Motif motif;
  int repeats;
};
constexpr Band BANDS[] = {
    {0.0, 0.07, solid, 1},       {0.085, 0.225, rays, 16},    {0.235, 0.245, solid, 1},
    {0.255, 0.355, solid, 1},    {0.365, 0.373, solid, 1},    {0.385, 0.435, zigzag, 40},
    {0.447, 0.455, solid, 1},    {0.467, 0.597, circles, 12}, {0.609, 0.617, solid, 1},
    {0.627, 0.687, meander, 24}, {0.697, 0.705, solid, 1},    {0.715, 0.765, tongues, 32},
    {0.775, 0.79, solid, 1},     {0.815, 0.865, zigzag, 14},  {0.885, 0.893, solid, 1},
    {0.905, 0.955, tongues, 18}, {0.967, 1.1, solid, 1},
};

bool is_glazed(glm::dvec3 p) {
  const double turn = 0.5 + std::atan2(p.z, p.x) / (2.0 * pi);
  return std::any_of(std::begin(BANDS), std::end(BANDS), [&](const Band& band) {
    const double around = turn * band.repeats;
    return p.y >= band.low && p.y < band.high &&
           band.motif(around - std::floor(around), (p.y - band.low) / (band.high - band.low));
  });
}

glm::dvec3 coloured(glm::dvec3 p, bool glazed) {
  const Sherd of = sherd(p + 0.02 * noise(30.0 * p));
  const double stain = rough_noise(9.0 * p);
  const glm::dvec3 clay = glm::mix(glm::dvec3(0.36, 0.125, 0.05), glm::dvec3(0.52, 0.24, 0.11), stain);
  const glm::dvec3 glaze = glm::mix(glm::dvec3(0.014, 0.011, 0.011), glm::dvec3(0.055, 0.026, 0.016), stain);
  const bool worn = rough_noise(26.0 * p + 3.0) > 0.66;
  glm::dvec3 color = glazed && !worn ? glaze : clay;
  if (of.depth < 0.0016) color = glm::dvec3(0.30, 0.21, 0.14);
  const double grain = hash(glm::ivec3(p * 1e5), 5);
  return color * (0.85 + 0.2 * of.shade) * (0.88 + 0.24 * grain);
}

Profile profile() {
  return spline({{0.12, 0.0},    {0.13, 0.015}, {0.115, 0.04}, {0.085, 0.065}, {0.095, 0.1},   {0.15, 0.2},
                 {0.215, 0.32},  {0.265, 0.45}, {0.282, 0.56}, {0.262, 0.66},  {0.2, 0.735},   {0.135, 0.775},
                 {0.105, 0.815}, {0.098, 0.86}, {0.104, 0.92}, {0.125, 0.96},  {0.148, 0.978}, {0.15, 0.995},
                 {0.135, 1.0},   {0.112, 0.98}, {0.09, 0.92},  {0.085, 0.82}});
}

OrientedPoints handle(const Sampling& sampling, double side) {
  constexpr double TUBE = 0.019;
  const Curve loop = [=](double parameter) {
    const double angle = 2.0 * pi * parameter;
    return glm::dvec3(side * (0.15 + 0.095 * std::cos(angle)), 0.83 + 0.1 * std::sin(angle), 0.0);
  };
  return painted(tube(sampling, loop, TUBE), [](glm::dvec3 p) { return coloured(p, true); });
}

/// One handle's share of the amphora's points, by area.
constexpr double HANDLE_SHARE = 0.045;

/// The whole surface, painted.
OrientedPoints surface(const Sampling& sampling) {
  const auto in_handle = static_cast<std::uint64_t>(HANDLE_SHARE * static_cast<double>(sampling.count));
  OrientedPoints all =
      painted(lathe({sampling.count - 2 * in_handle, sampling.even, sampling.seed}, profile()),
              [](glm::dvec3 p) { return coloured(p, is_glazed(p)); });
  for (const double side : {1.0, -1.0}) append(all, handle({in_handle, sampling.even, sampling.seed}, side));
  return all;
}

/// About `count` points that scanners on tripods around it measure.
OrientedPoints scanned(const Sampling& sampling, double area) {
  constexpr double DISTANCE = 2.2;
  constexpr double HEIGHTS[] = {1.5, 0.7, 1.5, 0.7, 1.5};
  constexpr double SEEN = 1.13;  // times the area, by all of them together, as they face it
  constexpr double SAMPLES = 6.0;
  const double step_rad =
      std::sqrt(SEEN * area / static_cast<double>(std::max<std::uint64_t>(1, sampling.count))) / DISTANCE;
  const OrientedPoints all =
      surface({static_cast<std::uint64_t>(SAMPLES * static_cast<double>(sampling.count)), sampling.even,
               sampling.seed});
  OrientedPoints measured;
  for (std::size_t i = 0; i < std::size(HEIGHTS); ++i) {
    const double angle = 2.0 * pi * static_cast<double>(i) / static_cast<double>(std::size(HEIGHTS)) + 0.4;
    append(
        measured,
        scan(all, {{DISTANCE * std::cos(angle), HEIGHTS[i], DISTANCE * std::sin(angle)}, step_rad, 0.0004}));
  }
  measured.is_scan = true;
  return measured;
}

}  // namespace

Model amphora() {
  const double area = lathe_area(profile()) / (1.0 - 2.0 * HANDLE_SHARE);
  return {{"amphora", area, [=](const Sampling& sampling) { return scanned(sampling, area); }}};
}

}  // namespace splatray
