// property_test [--seconds N] [--seed S]: random scenes and random rays, for as long as it is told. The GPU, the shaders
// compiled as C++, and brute force must agree on every ray (judge.h says what that means), and the GPU must answer the same
// bits for two leaf sizes; rounds of odd seeds decide hits in double-float, the others as the device does by default. Round n has seed S + n; a round that fails prints its seed, its scene and its rays, and
// `property_test --seconds 0 --seed` with that seed runs it alone.
#include <chrono>
#include <iostream>

#include "app/cli/option_types.h"
#include "engine/base/error.h"
#include "tests/property/round.h"

namespace splatray::testing {
namespace {

constexpr double MOST_SEED = 9007199254740992.0;  // 2^53: whole numbers are exact up to here

int body(int argc, char** argv) {
  double seconds = 30.0;
  std::uint64_t seed = 1;
  OptionList list("Random scenes and rays: GPU, C++ twin and brute force must agree.", "property_test");
  add_number(list, "--seconds", seconds, 0.0, 1e9, "how long, at least one round; default 30");
  add_number(list, "--seed", seed, 0, MOST_SEED, "of the first round; default 1");
  if (!list.parse(argc, argv)) return static_cast<int>(ExitCode::done);
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
