/// Keeps an even sample of the points that readers bring, and makes of it what can be shown before the scene is made.
#pragma once
#include <vector>

#include "app/view/model/document.h"
#include "app/view/thread/point_cloud.h"
#include "preprocess/points.h"

namespace splatray {

/// Points to look at, and the document that first shows them: its camera, directions and bounds count; it has no objects.
struct OpenedPoints {
  SharedPoints points;
  Document document;
};

/// An even sample of a scene's splats, coloured about as the document asks for: what is seen while the scene is brought to the
/// device.
[[nodiscard]] PointCloud points_of(const Scene& scene, const Document& document);

/// For one thread at a time.
class PointSampler {
 public:
  /// Most points kept: enough to fill a screen, and a frame of them takes some hundredths of a second.
  static constexpr std::size_t MOST = 1'500'000;

  /// `asked` as load_scene gets it.
  explicit PointSampler(Request asked) : asked_(std::move(asked)) {}

  /// Takes every n-th new point that is usable; n doubles, and every second one goes, when there are MOST.
  void add(const SeenPoints& seen);
  [[nodiscard]] std::size_t size() const { return kept_.position.size(); }
  /// Whether a scene of these points is made about as fast as what make() makes.
  [[nodiscard]] bool is_small() const;

  /// Those kept so far, seen as the scene will be: a scene of a few of them is built to find out how. Colours are
  /// the points' own, of scans without any, or shown by an attribute, their heights'. Throws Error as build_scene does.
  [[nodiscard]] OpenedPoints make() const;

 private:
  [[nodiscard]] Scene small_scene() const;
  [[nodiscard]] bool has_colors() const;
  [[nodiscard]] std::vector<std::uint32_t> own_colors() const;
  void keep(const Points& points, std::size_t i);
  void thin_out();

  Request asked_;
  Points kept_;  ///< position, stations and station; normal where given
  /// Beside them, as stored: 8 bits where `colored_` is 1, of a scale that all files together decide where 2, none where 0.
  std::vector<glm::u16vec3> stored_;
  std::vector<std::uint8_t> colored_;
  std::uint16_t largest_ = 0;  ///< channel of those whose scale is open
  std::size_t stride_ = 1, passed_ = 0;
  std::size_t first_station_ = 0;  ///< of the file that is read
  bool measured_ = true;
  std::optional<glm::dvec3> up_;
};

}  // namespace splatray
