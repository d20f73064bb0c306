/// splatray-bench COMMAND ...: measures splatray (commands.h). Built with the engine alone it has what runs on a bare GPU machine.
#include <cstdio>
#include <string>
#include <string_view>

#include "engine/base/error.h"
#include "tests/bench/commands.h"

namespace splatray::testing {
namespace {

struct Command {
  std::string_view name;
  int (*run)(int, char**);
};

constexpr Command COMMANDS[] = {
    {"run", bench_run},         {"scale", bench_scale}, {"pipelines", bench_pipelines},
#ifdef SPLATRAY_BENCH_WHOLE
    {"prepare", bench_prepare}, {"exact", bench_exact},
#endif
#ifdef SPLATRAY_EMBREE
    {"peers", bench_peers},     {"rays", bench_rays},   {"race", bench_race},
#endif
};

int run(int argc, char** argv) {
  std::string names;
  for (const Command& command : COMMANDS) {
    if (argc > 1 && command.name == argv[1]) return command.run(argc - 1, argv + 1);
    names += (names.empty() ? "" : ", ") + std::string(command.name);
  }
  if (argc > 1 && (argv[1] == std::string_view("-h") || argv[1] == std::string_view("--help"))) {
    std::printf("splatray-bench COMMAND ...: one of %s; each has --help\n", names.c_str());
    return static_cast<int>(ExitCode::done);
  }
  throw Error(ExitCode::usage, "found " + (argc > 1 ? "'" + std::string(argv[1]) + "'" : "no command") +
                                   ", expected " + names);
}

}  // namespace
}  // namespace splatray::testing

int main(int argc, char** argv) {
  return splatray::run_main("splatray-bench", splatray::testing::run, argc, argv);
}
