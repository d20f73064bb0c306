#include "preprocess/mesh/texture/texture_detail.h"

#include <algorithm>
#include <cmath>

#include "preprocess/mesh/sample_mesh.h"

namespace splatray {
namespace {

constexpr std::uint32_t BLOCK = 4;     ///< texels of the finest blocks' edges
constexpr double DETAIL_MARGIN = 4.0;  ///< texels beside detail that it needs points in, too: discs are round
constexpr double EVEN_SHARE = 0.5;     ///< of the samples, that are spread evenly
constexpr double MOST_TO_A_TEXEL = 4.0;  ///< twice as close as texels are
constexpr double UNEVEN_DENSITY = 1.5;   ///< a piece is divided where its parts' densities differ by more
constexpr double VERTEX_CHANGE = 0.05;   ///< between vertices, that points at them can show
constexpr int DEEPEST = 12;              ///< divisions of a triangle

using Corners = std::array<glm::dvec3, 3>;

/// The four parts that the edges' middles make of a piece.
std::array<Corners, 4> quarters(const Corners& corners) {
  const glm::dvec3 a = 0.5 * (corners[1] + corners[2]), b = 0.5 * (corners[2] + corners[0]),
                   c = 0.5 * (corners[0] + corners[1]);
  return {{{corners[0], c, b}, {c, corners[1], a}, {a, b, c}, {b, a, corners[2]}}};
}

int difference(const glm::u8vec4& a, const glm::u8vec4& b, std::span<const int> channels) {
  int most = 0;
  for (const int channel : channels) most = std::max(most, std::abs(int{a[channel]} - int{b[channel]}));
  return most;
}

/// Means of 2 x 2 blocks, of what there is of them.
std::vector<float> halved(const std::vector<float>& mean, std::uint32_t width, std::uint32_t height) {
  std::vector<float> half;
  for (std::uint32_t y = 0; y < height; y += 2)
    for (std::uint32_t x = 0; x < width; x += 2) {
      const std::uint32_t right = std::min(x + 1, width - 1), below = std::min(y + 1, height - 1);
      half.push_back(0.25F * (mean[y * width + x] + mean[y * width + right] + mean[below * width + x] +
                              mean[below * width + right]));
    }
  return half;
}

/// The textures of a mesh, and how they lie on it.
class MeshDetail {
 public:
  explicit MeshDetail(const Mesh& mesh) : mesh_(mesh) {
    // A mask's border is cut along lines, whatever the samples.
    if (mesh.texture) layers_.push_back({TextureDetail(*mesh.texture, std::array{0, 1, 2}), &mesh.texcoord});
    for (const SurfaceMap& map : mesh.maps) {
      if (map.channels.empty()) continue;
      std::vector<int> channels;
      for (const MapChannel& channel : map.channels) channels.push_back(channel.channel);
      layers_.push_back({TextureDetail(*map.texture, channels), map.texcoord.get()});
    }
  }

  [[nodiscard]] bool any() const { return !layers_.empty(); }

  /// What a piece of a triangle has.
  struct Found {
    double area = 0.0;    ///< world units^2
    double detail = 0.0;  ///< change to a world length, summed over the textures
    double texels = 0.0;  ///< to its area in the densest texture
    double length = 0.0;  ///< of its longest edge there, texels
  };
  [[nodiscard]] Found at(std::uint32_t triangle, const Corners& corners) const {
    const glm::uvec3& t = mesh_.triangles[triangle];
    const auto& p = mesh_.vertices.position;
    const auto place = [&](const glm::dvec3& w) { return w.x * p[t.x] + w.y * p[t.y] + w.z * p[t.z]; };
    const glm::dvec3 origin = place(corners[0]);
    Found found;
    found.area = 0.5 * glm::length(glm::cross(place(corners[1]) - origin, place(corners[2]) - origin));
    if (!(found.area > 0.0)) return found;
    for (const auto& [detail, texcoord] : layers_) {
      std::array<glm::vec2, 3> uv;
      for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3 w(corners[i]);
        uv[i] = w.x * (*texcoord)[t.x] + w.y * (*texcoord)[t.y] + w.z * (*texcoord)[t.z];
      }
      const double texels = detail.area(uv);
      found.texels = std::max(found.texels, texels);
      found.length = std::max(found.length, detail.longest_edge(uv));
      found.detail += detail.in(uv)*std::sqrt(texels / found.area);
    }
    return found;
  }

 private:
  struct Layer {
    TextureDetail detail;
    const std::vector<glm::vec2>* texcoord;
  };
  const Mesh& mesh_;
  std::vector<Layer> layers_;
};

/// Divides triangles into pieces whose detail is even.
class Divider {
 public:
  Divider(const MeshDetail& detail, double sample_area) : detail_(detail), sample_area_(sample_area) {}

  void divide(std::uint32_t triangle, const Corners& corners, int depth = 0) {
    MeshDetail::Found found = detail_.at(triangle, corners);
    const bool coarse = found.area > sample_area_ && found.length > BLOCK && depth < DEEPEST;
    if (coarse && is_uneven(triangle, corners, found.detail)) {
      for (const Corners& quarter : quarters(corners)) divide(triangle, quarter, depth + 1);
      return;
    }
    pieces.push_back({triangle, corners, std::pow(found.detail, 2.0 / 3.0)});
    founds.push_back(found);
  }

  std::vector<SamplePiece> pieces;  ///< `density` still to be scaled
  std::vector<MeshDetail::Found> founds;

 private:
  /// Whether its sixteenths differ, and their mean, which is more exact than that of the whole's box.
  [[nodiscard]] bool is_uneven(std::uint32_t triangle, const Corners& corners, double& mean) const {
    double least = INFINITY, most = 0.0;
    mean = 0.0;
    for (const Corners& quarter : quarters(corners))
      for (const Corners& sixteenth : quarters(quarter)) {
        const double detail = detail_.at(triangle, sixteenth).detail;
        least = std::min(least, detail);
        most = std::max(most, detail);
        mean += detail / 16.0;
      }
    return std::pow(most, 2.0 / 3.0) > UNEVEN_DENSITY * std::pow(least, 2.0 / 3.0);
  }

  const MeshDetail& detail_;
  const double sample_area_;
};

}  // namespace

TextureDetail::TextureDetail(const Texture& texture, std::span<const int> channels) : texture_(texture) {
  const TextureImage& image = *texture.image;
  Level level{(image.width + BLOCK - 1) / BLOCK, (image.height + BLOCK - 1) / BLOCK, BLOCK, {}};
  level.mean.assign(std::size_t{level.width} * level.height, 0.0F);
  std::vector<float> texels(level.mean.size(), 0.0F);
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const auto at = [&](std::uint32_t column, std::uint32_t row) {
        return image.texels[std::size_t{row} * image.width + column];
      };
      const glm::u8vec4 own = at(x, y);
      const int right = difference(own, at((x + 1) % image.width, y), channels);
      const int below = difference(own, at(x, (y + 1) % image.height), channels);
      const std::size_t block = std::size_t{y / BLOCK} * level.width + x / BLOCK;
      level.mean[block] += std::hypot(static_cast<float>(right), static_cast<float>(below)) / 255.0F;
      texels[block] += 1.0F;
    }
  for (std::size_t i = 0; i < texels.size(); ++i) level.mean[i] /= texels[i];
  levels_.push_back(std::move(level));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& fine = levels_.back();
    levels_.push_back({(fine.width + 1) / 2, (fine.height + 1) / 2, 2 * fine.block,
                       halved(fine.mean, fine.width, fine.height)});
  }
}

glm::dvec2 TextureDetail::texel_of(glm::vec2 texcoord) const {
  return glm::dvec2(texture_.place(texcoord)) * glm::dvec2(texture_.image->width, texture_.image->height);
}

double TextureDetail::in(const std::array<glm::vec2, 3>& texcoords) const {
  constexpr double BLOCKS_ACROSS = 4.0;
  const glm::dvec2 a = texel_of(texcoords[0]), b = texel_of(texcoords[1]), c = texel_of(texcoords[2]);
  const glm::dvec2 low = glm::min(a, glm::min(b, c)) - DETAIL_MARGIN,
                   high = glm::max(a, glm::max(b, c)) + DETAIL_MARGIN;
  const double span = std::max(high.x - low.x, high.y - low.y);
  std::size_t i = 0;
  while (i + 1 < levels_.size() && span > BLOCKS_ACROSS * levels_[i].block) ++i;
  const Level& level = levels_[i];
  // Beyond the picture it goes on, in whatever way: a period of it is as much as all.
  const glm::dvec2 size(texture_.image->width, texture_.image->height);
  double sum = 0.0, count = 0.0;
  const auto blocks = [&](int axis) {
    const double first = std::floor(low[axis] / level.block);
    const double last = std::min(std::floor(high[axis] / level.block), first + 2.0 * BLOCKS_ACROSS);
    return std::array{first, last};
  };
  const auto wrapped_block = [&](double block, int axis, std::uint32_t most) {
    const double texel = (block + 0.5) * level.block;
    const double inside = texel - size[axis] * std::floor(texel / size[axis]);
    return std::min(static_cast<std::uint32_t>(inside / level.block), most - 1);
  };
  const auto [left, right] = blocks(0);
  const auto [top, bottom] = blocks(1);
  for (double y = top; y <= bottom; ++y)
    for (double x = left; x <= right; ++x) {
      sum += double(level.mean[std::size_t{wrapped_block(y, 1, level.height)} * level.width +
                               wrapped_block(x, 0, level.width)]);
      count += 1.0;
    }
  return sum / count;
}

double TextureDetail::longest_edge(const std::array<glm::vec2, 3>& texcoords) const {
  const glm::dvec2 a = texel_of(texcoords[0]), b = texel_of(texcoords[1]), c = texel_of(texcoords[2]);
  return std::max(glm::distance(a, b), std::max(glm::distance(b, c), glm::distance(c, a)));
}

double TextureDetail::area(const std::array<glm::vec2, 3>& texcoords) const {
  const glm::dvec2 a = texel_of(texcoords[0]), u = texel_of(texcoords[1]) - a, v = texel_of(texcoords[2]) - a;
  return 0.5 * std::abs(u.x * v.y - u.y * v.x);
}

std::vector<SamplePiece> sample_pieces(const Mesh& mesh, const std::vector<std::uint32_t>& order,
                                       std::uint64_t count) {
  static constexpr Corners WHOLE{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  const MeshDetail detail(mesh);
  if (!detail.any()) {
    std::vector<SamplePiece> whole;
    for (const std::uint32_t triangle : order) whole.push_back({triangle, WHOLE, 1.0});
    return whole;
  }
  const double sample_area = surface_area(mesh) / static_cast<double>(count);
  Divider divider(detail, sample_area);
  for (const std::uint32_t triangle : order) divider.divide(triangle, WHOLE);
  double area = 0.0, weighted = 0.0;
  for (std::size_t i = 0; i < divider.pieces.size(); ++i) {
    area += divider.founds[i].area;
    weighted += divider.founds[i].area * divider.pieces[i].density;
  }
  for (std::size_t i = 0; i < divider.pieces.size(); ++i) {
    double& density = divider.pieces[i].density;
    const MeshDetail::Found& found = divider.founds[i];
    const double by_detail = weighted > 0.0 ? (1.0 - EVEN_SHARE) * density * area / weighted : 0.0;
    const double most = found.area > 0.0 ? MOST_TO_A_TEXEL * found.texels / found.area * sample_area : 0.0;
    density = std::max(EVEN_SHARE, std::min(EVEN_SHARE + by_detail, most));
  }
  return std::move(divider.pieces);
}

bool is_finer_than_vertices(const Mesh& mesh) {
  static constexpr Corners WHOLE{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  const MeshDetail detail(mesh);
  if (!detail.any()) return false;
  double area = 0.0, change = 0.0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const MeshDetail::Found found = detail.at(i, WHOLE);
    area += found.area;
    change += found.area * found.detail;
  }
  return area > 0.0 && change / area * std::sqrt(area / double(mesh.vertices.size())) > VERTEX_CHANGE;
}

}  // namespace splatray
