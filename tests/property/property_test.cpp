// property_test [--seconds N] [--rounds N] [--seed S|random]: random scenes and random rays, for as long as asked.
// The GPU, the shaders compiled as C++, and brute force must agree on every ray (judge.h says what that means), and the
// GPU must answer the same bits for two leaf sizes; rounds of odd seeds decide hits in double-float, the others as the
// device does by default. Round n has seed S + n; a round that fails prints its seed, its scene and its rays, and
// `property_test --seconds 0 --seed` with that seed runs it alone.
#include <chrono>
#include <iostream>
#include <random>

#include "app/cli/option_types.h"
#include "engine/base/error.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "tests/property/round.h"

namespace splatray::testing {
namespace {

// Excuses that are allowed: measured 5e-4 and 1.5e-4 of the answers over 20 rounds; a single round has them in clusters.
constexpr double MOST_TIES = 1e-3, MOST_EDGE_ON = 5e-4;
constexpr double MOST_OF_A_ROUND = 100.0;
constexpr double LEAST_HITS = 0.05;               ///< of the rays
constexpr double MOST_SEED = 9007199254740992.0;  // 2^53: whole numbers are exact up to here

int body(int argc, char** argv) {
  double seconds = 30.0;
  std::uint64_t seed = 1, rounds = 1;
  OptionList list("Random scenes and rays: GPU, C++ twin and brute force must agree.", "property_test");
  add_number(list, "--seconds", seconds, 0.0, 1e9, "how long; default 30");
  add_number(list, "--rounds", rounds, 1, 1e9, "at least this many, however long they take; default 1");
  const auto read_seed = [&](const std::string& text) {
    seed =
        text == "random" ? std::random_device()() : read_option<std::uint64_t>("--seed", text, 0, MOST_SEED);
  };
  list.add_value("--seed", read_seed, "of the first round, or random; default 1", "N|random");
  if (!list.parse(argc, argv)) return static_cast<int>(ExitCode::done);
  const VulkanDevice device;
  ShownTracer tracer(device);
  RoundCounts counts;
  const auto start = std::chrono::steady_clock::now();
  do {
    const std::uint64_t round = seed + counts.rounds;
    run_round(round, tracer, counts, std::cout);
  } while (counts.rounds < rounds ||
           std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < seconds);
  std::cout << "--seed " << seed << ": " << counts.rounds << " rounds, " << counts.rays << " rays, "
            << counts.hits << " hits, " << counts.ties << " ties, " << counts.edge_on << " edge-on, "
            << counts.exceptions << " exceptions\n";
  // Each ray is judged twice. Many excuses, or rays that miss, mean that the tracer or this test is not what it was.
  const double judged = 2.0 * double(counts.rays);
  const bool few_ties = double(counts.ties) <= MOST_OF_A_ROUND + MOST_TIES * judged;
  const bool few_edge_on = double(counts.edge_on) <= MOST_OF_A_ROUND + MOST_EDGE_ON * judged;
  const bool many_hits = double(counts.hits) >= LEAST_HITS * double(counts.rays);
  if (!few_ties || !few_edge_on) std::cout << "too many excuses\n";
  if (!many_hits) std::cout << "too few hits\n";
  return counts.exceptions == 0 && few_ties && few_edge_on && many_hits ? 0 : 1;
}

}  // namespace
}  // namespace splatray::testing

int main(int argc, char** argv) {
  return splatray::run_main("property_test", splatray::testing::body, argc, argv);
}
