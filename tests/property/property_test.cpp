// property_test [--seconds N] [--seed S]: random scenes and random rays, for as long as it is told. The GPU, the shaders
// compiled as C++, and brute force must agree on every ray (judge.h says what that means), and the GPU must answer the same
// bits for two leaf sizes; rounds of odd seeds decide hits in double-float, the others as the device does by default. Round n has seed S + n; a round that fails prints its seed, its scene and its rays, and
// `property_test --seconds 0 --seed` with that seed runs it alone.
#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>

#include "engine/base/error.h"
#include "tests/property/round.h"

namespace splatray::testing {
namespace {

int body(int argc, char** argv) {
  double seconds = 30.0;
  std::uint64_t seed = 1;
  CLI::App app("Random scenes and rays: GPU, C++ twin and brute force must agree");
  app.add_option("--seconds", seconds, "how long, at least one round; default 30");
  app.add_option("--seed", seed, "of the first round; default 1");
  CLI11_PARSE(app, argc, argv);
  const Context context;
  Tracer tracers[] = {Tracer(context), Tracer(context, {.kernels = Kernels::gpu})};
  RoundCounts counts;
  const auto start = std::chrono::steady_clock::now();
  do {
    const std::uint64_t round = seed + counts.rounds;
    run_round(round, tracers[round % 2], counts, std::cout);
  } while (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < seconds);
  std::cout << counts.rounds << " rounds, " << counts.rays << " rays, " << counts.hits << " hits, "
            << counts.ties << " ties, " << counts.exceptions << " exceptions\n";
  return counts.exceptions == 0 ? 0 : 1;
}

}  // namespace
}  // namespace splatray::testing

int main(int argc, char** argv) {
  return splatray::run_main("property_test", splatray::testing::body, argc, argv);
}
