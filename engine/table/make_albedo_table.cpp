// make_albedo_table OUT.cpp: the albedo table (shaders/lang/albedo_layout.h) as C++, made by quadrature over the facets that the
// shaders choose. Run when the project is built.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <future>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "shaders/lang/albedo_layout.h"

namespace splatray {
namespace {

std::vector<float> table;

namespace glsl {

#include "shaders/lang/glsl_as_cpp.h"

float albedo_at(uint index) { return table[index]; }

#include "shaders/light/albedo.glsl"

}  // namespace glsl

/// Points of a Fibonacci lattice (Sloan and Joe 1994, "Lattice Methods for Multiple Integration", ch. 5): two Fibonacci numbers
/// that follow each other.
struct Lattice {
  std::uint64_t points, step;
};
constexpr Lattice COARSE{1597, 987};
constexpr Lattice FINE{10946, 6765};
constexpr int MEAN_POINTS = 1024;

glm::vec3 eye_of(float cosine) { return {std::sqrt(1.0F - cosine * cosine), 0.0F, cosine}; }

float alpha_of(std::uint32_t row) {
  const float roughness = static_cast<float>(row) / static_cast<float>(ALBEDO_ROWS - 1);
  return std::max(roughness * roughness, glsl::ALPHA_LEAST);
}

/// Facets as often as an eye sees them, of one half: the other is its mirror image. The few that are steep count most for what is
/// lost, so points are dense there, and weigh less.
struct Facets {
  std::vector<glm::vec3> normals;
  std::vector<double> weights;

  Facets(const glm::vec3& to_eye, float alpha, Lattice lattice) {
    const auto count = static_cast<float>(lattice.points);
    for (std::uint64_t i = 0; i < lattice.points; ++i) {
      const float t = (static_cast<float>(i) + 0.5F) / count;
      const float turn = 0.5F * (static_cast<float>(i * lattice.step % lattice.points) + 0.5F) / count;
      normals.push_back(glsl::ggx_facet(to_eye, alpha, 1.0F, {turn, 1.0F - t * t * t * t}));
      weights.push_back(4.0 * double(t) * double(t) * double(t));
    }
  }

  /// The mean of what measure(facet) gives.
  template <class Measure>
  [[nodiscard]] auto mean(const Measure& measure) const {
    auto sum = measure(normals[0]) * weights[0];
    for (std::size_t i = 1; i < normals.size(); ++i) sum += measure(normals[i]) * weights[i];
    return sum / double(normals.size());
  }
};

/// The fraction of the light mirrored by facets that the eye sees which no others hide.
float mirrored_share(const glm::vec3& to_eye, const glm::vec3& to_light, float alpha) {
  if (!(to_light.z > 0.0F)) return 0.0F;
  return 2.0F * to_light.z * (to_eye.z + glsl::ggx_stretch(to_eye.z, alpha)) *
         glsl::ggx_visible(to_eye.z, to_light.z, alpha);
}

glm::dvec2 reflectance_factors(const glm::vec3& to_eye, float alpha) {
  return Facets(to_eye, alpha, FINE).mean([&](const glm::vec3& facet) {
    const float cosine = glm::dot(to_eye, facet), edge = glsl::schlick(cosine);
    const float share = mirrored_share(to_eye, facet * (2.0F * cosine) - to_eye, alpha);
    return glm::dvec2(share * (1.0F - edge), share * edge);
  });
}

/// What both sides of a dielectric give to the eye.
double glass_albedo(const glm::vec3& to_eye, float alpha, float eta, const Facets& facets) {
  return facets.mean([&](const glm::vec3& facet) {
    const float cosine = std::max(glm::dot(to_eye, facet), 1e-6F);
    float behind = 0.0F;
    const float share = glsl::fresnel(eta, cosine, behind);
    const glm::vec3 through = facet * (eta * cosine - behind) - to_eye * eta;
    const float mirrored = share * mirrored_share(to_eye, facet * (2.0F * cosine) - to_eye, alpha);
    const bool passes = through.z < 0.0F && share < 1.0F;
    return double(mirrored + (passes ? (1.0F - share) * glsl::ggx_seen(-through.z, alpha) : 0.0F));
  });
}

float column_cosine(std::uint32_t column, std::uint32_t row) {
  const float x = std::max(static_cast<float>(column), 0.05F) / static_cast<float>(ALBEDO_COLUMNS - 1);
  const float w = std::max(alpha_of(row), 1e-3F);
  return std::min(w * (std::pow(1.0F + 1.0F / w, x) - 1.0F), 1.0F);
}

void add_reflectances() {
  for (std::uint32_t row = 0; row < ALBEDO_ROWS; ++row)
    for (std::uint32_t column = 0; column < ALBEDO_COLUMNS; ++column) {
      const glm::dvec2 factors = reflectance_factors(eye_of(column_cosine(column, row)), alpha_of(row));
      const double all = factors.x + factors.y, edge = double(glsl::schlick(column_cosine(column, row)));
      table.push_back(static_cast<float>(all));
      table.push_back(static_cast<float>(factors.y - edge * all));
    }
  for (std::uint32_t row = 0; row < ALBEDO_ROWS; ++row) {
    glm::dvec2 sum(0.0);
    for (int i = 0; i < MEAN_POINTS; ++i) {
      const float t = (static_cast<float>(i) + 0.5F) / MEAN_POINTS;
      const float cosine = t * t * t * t;  // dense at the horizon, where smooth facets hide each other
      sum += 8.0 * double(cosine) * double(t) * double(t) * double(t) *
             glm::dvec2(glsl::albedo_factors(cosine, std::max(alpha_of(row), 1.01F * glsl::ALPHA_LEAST)));
    }
    table.push_back(static_cast<float>(sum.x / MEAN_POINTS));
    table.push_back(static_cast<float>(sum.y / MEAN_POINTS));
  }
}

/// One row of all dielectrics. Many facets where total internal reflection cuts lobes: with FINE 0.2 % at worst, 0.02 % rms.
void fill_glass_row(std::uint32_t row) {
  const float alpha = alpha_of(row);
  for (std::uint32_t column = 0; column < ALBEDO_COLUMNS; ++column) {
    const glm::vec3 to_eye = eye_of(column_cosine(column, row));
    const Facets coarse(to_eye, alpha, COARSE), fine(to_eye, alpha, FINE);
    for (std::uint32_t k = 0; k < ALBEDO_ETAS; ++k) {
      const float root = 2.0F * static_cast<float>(k) / static_cast<float>(ALBEDO_ETAS - 1) - 1.0F;
      const float z = glsl::ALBEDO_ETA_MOST * root * std::abs(root);
      const float eta = (1.0F + z) / (1.0F - z);
      table[ALBEDO_GLASS + (k * ALBEDO_ROWS + row) * ALBEDO_COLUMNS + column] =
          static_cast<float>(glass_albedo(to_eye, alpha, eta, eta > 1.0F && alpha > 0.1F ? fine : coarse));
    }
  }
}

void add_glass() {
  table.resize(ALBEDO_WORDS);
  std::vector<std::future<void>> rows;
  for (std::uint32_t row = 0; row < ALBEDO_ROWS; ++row)
    rows.push_back(std::async(std::launch::async, fill_glass_row, row));
  for (std::future<void>& row : rows) row.get();
}

bool write(const char* path) {
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) return false;
  std::fputs("#include \"engine/table/albedo_table.h\"\nstatic constexpr float VALUES[] = {", file);
  for (std::size_t i = 0; i < table.size(); ++i)
    std::fprintf(file, "%s%.8eF,", i % 8 == 0 ? "\n" : "", double(table[i]));
  std::fputs("};\nconst std::span<const float> splatray::ALBEDO_TABLE(VALUES);\n", file);
  const bool written = std::ferror(file) == 0;
  return std::fclose(file) == 0 && written;
}

}  // namespace

/// Makes the table and writes it; whether that went well.
static bool make_table(const char* path) {
  table.reserve(ALBEDO_WORDS);
  add_reflectances();
  if (table.size() != ALBEDO_GLASS) return false;
  add_glass();
  return write(path);
}

}  // namespace splatray

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  if (splatray::make_table(argv[1])) return 0;
  std::fprintf(stderr, "make_albedo_table: error: cannot write '%s'\n", argv[1]);
  return 1;
}
