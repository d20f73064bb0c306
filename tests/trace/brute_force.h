/// The truth of what a ray hits: every splat tested, in float64, with formulas of its own (ARCHITECTURE.md,
/// "What a hit is"). Knows nothing of octrees, leaves or the shaders.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/image/view.h"
#include "engine/scene/scene.h"
#include "engine/scene/splat.h"

namespace splatray::testing {

/// What a ray hits. Distances in units of |dir|, root space.
struct TrueHit {
  bool found = false;
  double t = 0.0;  ///< blended
  double t_first = 0.0;
  glm::dvec3 normal{0.0};  ///< blended unit normal, turned against the ray
  glm::dvec3 color{1.0};   ///< blended linear colour
  std::uint32_t object = NO_OBJECT;
  std::uint32_t members = 0;
  std::size_t first = 0;  ///< index into splats()
  bool front = true;
};

class BruteForce {
 public:
  /// Takes the scene's splats once each and its materials.
  explicit BruteForce(const Scene& scene);
  virtual ~BruteForce() = default;
  BruteForce(const BruteForce&) = default;
  BruteForce& operator=(const BruteForce&) = default;

  /// Settings used: blend (BLEND_WINDOW or BLEND_NEAREST), kernel, kappa, side (SIDE_SIDE or SIDE_NONE), region.
  [[nodiscard]] TrueHit nearest(const RayQuery& query, const Settings& settings) const;
  /// The objects of all hits with t < t_max, in no order, with repetition.
  [[nodiscard]] std::vector<std::uint32_t> objects_met(const RayQuery& query, const Settings& settings,
                                                       double t_max) const;

  [[nodiscard]] const std::vector<uvec4>& words() const { return words_; }
  [[nodiscard]] const std::vector<Splat>& splats() const { return splats_; }
  /// Replaces all materials (same count).
  void set_materials(const std::vector<Material>& materials) { materials_ = materials; }
  /// Moves one splat's centre, to prove that a comparison can fail.
  void move_splat(std::size_t index, glm::dvec3 by_root);
  /// Turns one splat's unit normal towards normal + by.
  void turn_splat(std::size_t index, glm::dvec3 by);

 protected:
  /// Sets `near` to the splats, by index and once each, whose balls of a disc's radius the ray's line may meet: all that it does
  /// and perhaps others.
  virtual void find_near(const RayQuery& query, std::vector<std::uint32_t>& near) const;

 private:
  /// A disc the ray meets.
  struct Meeting {
    double t;
    double u_squared;
    double cosine;  ///< unit normal . unit direction
    std::size_t index;
  };
  /// The surface at a meeting, by the splat's normal field.
  struct Facet {
    glm::dvec3 normal;  ///< unit, turned against the ray
    double t;
  };
  /// Whether an offset from a disc's centre is before its clip lines, by the rule in shaders/layout.h.
  [[nodiscard]] bool kept(std::size_t index, const glm::dvec3& from_center) const;
  [[nodiscard]] bool is_ellipse(std::size_t index) const;
  /// The squared distance from a splat's centre as an ellipse takes it, by the same rule.
  [[nodiscard]] double rho_squared(std::size_t index, const glm::dvec3& from_center) const;
  /// The vector m of a direction there.
  [[nodiscard]] glm::dvec3 across(std::size_t index, int direction) const;
  [[nodiscard]] Facet facet(const Meeting& meeting, const RayQuery& query) const;
  [[nodiscard]] std::vector<Meeting> meetings(const RayQuery& query, const Settings& settings) const;
  [[nodiscard]] bool counts(const Meeting& meeting, const RayQuery& query, const Settings& settings) const;

  RootTransform root_;
  std::vector<uvec4> words_;
  std::vector<Splat> splats_;
  std::vector<glm::dmat3> slopes_;  ///< normal fields; zero for flat discs
  std::vector<glm::dvec3> leans_;   ///< their constant terms
  std::vector<std::uint32_t> colors_;
  std::vector<std::uint32_t> clips_;  ///< clip lines; empty where all discs are whole
  std::vector<Material> materials_;
  std::vector<double> x_, y_, z_, radius_squared_;  ///< the splats again, for the first coarse pass
};

}  // namespace splatray::testing
