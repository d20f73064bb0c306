#include "tests/bench/measure/race.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "engine/base/error.h"
#include "tests/bench/cases/statistics.h"
#include "tests/bench/measure/speed_record.h"
#include "tests/bench/truth/bounces.h"

namespace splatray::testing {
namespace {

struct RayClass {
  const char* name;
  Frame frame;
  std::optional<Frame> without;
};

constexpr RayClass PRIMARY{"primary", Frame::primary, {}}, RANDOM{"random", Frame::random, {}},
    SHADOW{"shadow", Frame::shadow, Frame::primary}, MIRROR{"mirror", Frame::mirror, Frame::inside};

/// Milliseconds of each round.
using Times = std::map<Frame, std::vector<double>>;

std::vector<Times> run_rounds(const std::vector<Racer*>& racers, const std::vector<Frame>& frames) {
  std::vector<Times> times(racers.size());
  for (Racer* racer : racers) {
    for (const Frame frame : frames) static_cast<void>(racer->run(frame));
    racer->warm();
  }
  for (std::size_t round = 0; round < RACE_ROUNDS; ++round)
    for (const Frame frame : frames)
      for (std::size_t i = 0; i < racers.size(); ++i) times[i][frame].push_back(racers[i]->run(frame));
  return times;
}

double ppm(std::uint64_t part, std::uint64_t whole) {
  return 1e6 * static_cast<double>(part) / static_cast<double>(whole);
}

bool unlike(double depth, double reference, double most) {
  if (std::isinf(depth) || std::isinf(reference)) return depth != reference;
  return !(std::abs(depth - reference) <= most);
}

/// World depths of what is compared between racers, +inf on misses.
struct Depths {
  std::vector<double> picture, random;
};

Depths depths_of(Racer& racer, const Course& course) {
  Depths depths;
  for (const AovPixel& pixel : racer.picture().aov) depths.picture.push_back(pixel.z);
  for (const RayHit& hit : racer.intersect(course.probes.rays()))
    depths.random.push_back(hit.t * course.root.unit_world);
  return depths;
}

double unlike_ppm(const std::vector<double>& depths, const std::vector<double>& reference,
                  const Course& course) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < depths.size(); ++i)
    count += unlike(depths[i], reference[i], UNLIKE_RADII * course.radius_world) ? 1 : 0;
  return ppm(count, depths.size());
}

void add_class_errors(const Case& one, const Course& course, Racer& racer, const RayClass& rays,
                      Json& record) {
  Json& error = record["error"];
  error["truth"] = "analytic";
  const auto intersect = [&](std::span<const RayQuery> queries) { return racer.intersect(queries); };
  switch (rays.frame) {
    case Frame::primary:
      add_errors(error, errors_of(racer.picture(), course.truth, course.outside, course.diagonal_world));
      break;
    case Frame::random:
      add_errors(error, course.probes.measure(intersect, course.radius_world));
      break;
    case Frame::shadow:
      error["false_shadows_ppm"] = ppm(racer.false_shadows(), racer.count_rays(Frame::shadow));
      break;
    default: {
      const Bounces bounces =
          ball_bounces(intersect, course.root, course.radius_world, one.rays / MOST_BOUNCES);
      error["wrong_bounces_ppm"] = ppm(bounces.wrong, bounces.counted);
    }
  }
}

void add_speed(const Course& course, Racer& racer, const RayClass& rays, const Times& times, Json& record) {
  const std::vector<double>& frame = times.at(rays.frame);
  std::vector<double> cost = frame;
  for (std::size_t i = 0; rays.without && i < cost.size(); ++i) cost[i] -= times.at(*rays.without)[i];
  const double cost_ms = quantile(cost, 0.5);
  const double count = rays.frame == Frame::primary ? double(course.outside.width) * course.outside.height
                                                    : static_cast<double>(racer.count_rays(rays.frame));
  Json& speed = record["speed"];
  add_times(speed, frame, count);
  speed["cost_ms_median"] = cost_ms;
  speed["cost_ms_min"] = *std::min_element(cost.begin(), cost.end());
  speed["cost_ms_max"] = *std::max_element(cost.begin(), cost.end());
  speed["rays"] = count;
  speed["rays_per_s"] = count / (cost_ms / 1000.0);
}

void require_like(const Json& record) {
  const double value = record["error"]["unlike_ppm"];
  if (value > MOST_UNLIKE_PPM)
    throw Error(ExitCode::failed, record["case"].get<std::string>() + ": found " + std::to_string(value) +
                                      " ppm of " + record["method"].get<std::string>() +
                                      "'s answers unlike splatray's, expected at most " +
                                      std::to_string(MOST_UNLIKE_PPM));
}

}  // namespace

std::vector<Json> race(const Case& one, const Course& course, const std::vector<Racer*>& racers,
                       bool secondary) {
  std::vector<RayClass> classes{PRIMARY, RANDOM};
  std::vector<Frame> frames{Frame::primary, Frame::random};
  if (secondary) {
    classes.insert(classes.end(), {SHADOW, MIRROR});
    frames.insert(frames.end(), {Frame::shadow, Frame::inside, Frame::mirror});
  }
  const std::vector<Times> times = run_rounds(racers, frames);
  const Depths reference = depths_of(*racers.front(), course);
  std::vector<Json> records;
  for (std::size_t i = 0; i < racers.size(); ++i) {
    Json base = start_record(one, one.runs.front(), course.splats);
    racers[i]->describe(base);
    if (i > 0) base["against"] = records.front()["method"];
    const Depths depths = depths_of(*racers[i], course);
    for (const RayClass& rays : classes) {
      Json record = base;
      record["rays"] = rays.name;
      add_speed(course, *racers[i], rays, times[i], record);
      add_class_errors(one, course, *racers[i], rays, record);
      if (rays.frame == Frame::primary)
        record["error"]["unlike_ppm"] = unlike_ppm(depths.picture, reference.picture, course);
      if (rays.frame == Frame::random)
        record["error"]["unlike_ppm"] = unlike_ppm(depths.random, reference.random, course);
      if (record["error"].contains("unlike_ppm")) require_like(record);
      records.push_back(record);
    }
  }
  for (Json& record : records)
    if (!record.contains("against") && racers.size() > 1) record["against"] = records.back()["method"];
  return records;
}

}  // namespace splatray::testing
