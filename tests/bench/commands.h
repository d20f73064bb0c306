/// The commands of splatray-bench: each reads its own words, argv[0] being what comes before them, and returns an exit code. Errors
/// are thrown. Each is in a file of its name.
#pragma once

namespace splatray::testing {

/// Pictures and frames of the report's cases.
int bench_run(int argc, char** argv);
/// Features, coverage and rays of splatray alone.
int bench_scale(int argc, char** argv);
/// What the driver says of the programs: registers, code, spills.
int bench_pipelines(int argc, char** argv);

// Not where the engine is built alone:
/// Makes the cases.
int bench_prepare(int argc, char** argv);
/// Hits beside brute force.
int bench_exact(int argc, char** argv);

// With Embree:
/// Embree on the report's cases.
int bench_peers(int argc, char** argv);
/// Splatray and Embree on spheres, one frame each in turn.
int bench_rays(int argc, char** argv);
/// The same on scenes, in all settings.
int bench_race(int argc, char** argv);

}  // namespace splatray::testing
