/// The commands of splatray-bench: each reads its own words, argv[0] being what comes before them, and returns an exit code. Errors
/// are thrown.
#pragma once

namespace splatray::testing {

int bench_run(int argc, char** argv);    ///< run_command.cpp: pictures and frames of the report's cases
int bench_scale(int argc, char** argv);  ///< scale_command.cpp: features, coverage, rays of splatray alone

// Not where the engine is built alone:
int bench_prepare(int argc, char** argv);  ///< prepare_command.cpp: makes the cases
int bench_exact(int argc, char** argv);    ///< exact_command.cpp: hits beside brute force

// With Embree:
int bench_peers(int argc, char** argv);  ///< peers_command.cpp: Embree on the report's cases
int bench_rays(int argc,
               char** argv);  ///< rays_command.cpp: splatray and Embree, one frame each in turn, on spheres
int bench_race(int argc, char** argv);  ///< race_command.cpp: the same on scenes, in all settings

}  // namespace splatray::testing
