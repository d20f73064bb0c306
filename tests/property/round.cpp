#include "tests/property/round.h"

#include <cstring>
#include <iomanip>
#include <string>

#include "engine/scene/splat.h"
#include "tests/property/judge.h"
#include "tests/property/random_rays.h"
#include "tests/property/random_scene.h"
#include "tests/trace/rays.h"
#include "tests/trace/twin.h"

namespace splatray::testing {
namespace {

constexpr std::size_t PRIMARY_RAYS = 3000;
constexpr std::uint64_t EXCEPTIONS_PRINTED = 5;

struct Asked {
  std::vector<RayQuery> rays;
  std::vector<TrueHit> truth;

  void add(const std::vector<RayQuery>& more, const BruteForce& brute, const Settings& settings) {
    const std::vector<TrueHit> hits = all_nearest(brute, more, settings);
    rays.insert(rays.end(), more.begin(), more.end());
    truth.insert(truth.end(), hits.begin(), hits.end());
  }
};

/// Random rays, the rays that go on from their hits, and those from theirs.
Asked ask(const Scene& scene, const BruteForce& brute, const Settings& settings, Dice& dice) {
  Asked asked;
  asked.add(random_rays(scene, brute, PRIMARY_RAYS, dice), brute, settings);
  for (int bounce = 0; bounce < 2; ++bounce)
    asked.add(secondary_rays(scene, asked.rays, asked.truth, dice.seed()), brute, settings);
  return asked;
}

std::ostream& operator<<(std::ostream& out, const vec3& v) {
  return out << '(' << v.x << ' ' << v.y << ' ' << v.z << ')';
}

void print(std::ostream& out, const RayQuery& ray, const TrueHit& truth, const BruteForce& brute) {
  out << std::setprecision(9) << "  ray origin " << ray.origin << " direction " << ray.dir << " t_min "
      << ray.t_min << " inside " << ray.inside << " from object " << ray.from_object << ' ' << ray.from_normal
      << '\n';
  out << "  truth: " << (truth.found ? "hit" : "miss");
  if (truth.found) {
    const Splat& splat = brute.splats()[truth.first];
    out << " t " << truth.t_first << " blended " << truth.t << " object " << truth.object << " members "
        << truth.members << " colour " << vec3(truth.color) << " normal " << vec3(truth.normal)
        << " first: center " << vec3(splat.center) << " radius " << std::sqrt(splat.radius_squared)
        << " normal " << vec3(splat.normal);
  }
  out << '\n';
}

void print(std::ostream& out, const RayHit& answer) {
  if (answer.object == NO_OBJECT) {
    out << "miss\n";
    return;
  }
  const Splat splat = unpack_splat(answer.first);
  out << "hit t " << answer.t_first << " blended " << answer.t << " object " << answer.object << " members "
      << answer.members << " colour " << unpack_color(answer.color) << " normal " << answer.normal
      << " first: center " << vec3(splat.center) << " radius " << std::sqrt(splat.radius_squared)
      << " normal " << vec3(splat.normal) << '\n';
}

/// Who answered, and what.
struct Answers {
  const char* who;
  std::vector<RayHit> hits;
};

class Round {
 public:
  Round(std::uint64_t seed, RoundCounts& counts, std::ostream& out, bool spoil)
      : seed_(seed), dice_(seed), random_(random_scene(dice_)), counts_(counts), out_(out), spoil_(spoil) {}

  void run(ShownTracer& tracer) {
    const Scene scene = built(random_, random_.leaf_sizes[0]);
    const Scene other = built(random_, random_.leaf_sizes[1]);
    BruteForce brute(scene);
    Asked asked = ask(scene, brute, random_.settings, dice_);
    if (spoil_) spoil(brute, asked);
    tracer.upload(scene);
    const Answers gpu{"GPU", tracer.intersect(asked.rays, random_.settings)};
    tracer.upload(other);
    const Answers gpu_other{"GPU, other leaf size", tracer.intersect(asked.rays, random_.settings)};
    const Answers twin{"C++ twin", twin_intersect(scene, asked.rays, random_.settings)};
    ++counts_.rounds;
    counts_.rays += asked.rays.size();
    for (const TrueHit& hit : asked.truth) counts_.hits += hit.found ? 1 : 0;
    judge_all(brute, asked, gpu);
    judge_all(brute, asked, twin);
    // A tree drops equal splats beyond its leaf size: then the other scene has other splats.
    if (scene.data_pool.size() == other.data_pool.size()) compare_bits(brute, asked, gpu, gpu_other);
  }

 private:
  /// Moves the splat that most likely matters, the first one hit, by its radius.
  void spoil(BruteForce& brute, Asked& asked) const {
    for (const TrueHit& hit : asked.truth) {
      if (!hit.found) continue;
      brute.move_splat(hit.first, std::sqrt(brute.splats()[hit.first].radius_squared) * glm::dvec3(0.5));
      break;
    }
    asked.truth = all_nearest(brute, asked.rays, random_.settings);
  }

  void judge_all(const BruteForce& brute, const Asked& asked, const Answers& answers) {
    const Judge judge(brute, random_.settings);
    for (std::size_t i = 0; i < asked.rays.size() && printed_ < EXCEPTIONS_PRINTED; ++i) {
      const Verdict verdict = judge.judge(asked.rays[i], asked.truth[i], answers.hits[i]);
      counts_.ties += verdict == Verdict::tie ? 1 : 0;
      counts_.edge_on += verdict == Verdict::edge_on ? 1 : 0;
      if (verdict != Verdict::wrong) continue;
      count_exception("wrong answer");
      print(out_, asked.rays[i], asked.truth[i], brute);
      print(out_ << "  " << answers.who << ": ", answers.hits[i]);
    }
  }

  void compare_bits(const BruteForce& brute, const Asked& asked, const Answers& one, const Answers& two) {
    for (std::size_t i = 0; i < asked.rays.size() && printed_ < EXCEPTIONS_PRINTED; ++i) {
      if (std::memcmp(&one.hits[i], &two.hits[i], sizeof(RayHit)) == 0) continue;
      count_exception("another leaf size, other bits");
      print(out_, asked.rays[i], asked.truth[i], brute);
      print(out_ << "  " << one.who << ": ", one.hits[i]);
      print(out_ << "  " << two.who << ": ", two.hits[i]);
    }
  }

  void count_exception(const char* what) {
    ++counts_.exceptions;
    ++printed_;
    out_ << what << " in the round of --seed " << seed_ << "; " << random_.description << '\n';
  }

  std::uint64_t seed_;
  Dice dice_;
  RandomScene random_;
  RoundCounts& counts_;
  std::ostream& out_;
  bool spoil_;
  std::uint64_t printed_ = 0;
};

}  // namespace

void run_round(std::uint64_t seed, ShownTracer& tracer, RoundCounts& counts, std::ostream& out, bool spoil) {
  Round(seed, counts, out, spoil).run(tracer);
}

}  // namespace splatray::testing
