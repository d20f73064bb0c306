#include "app/cli/load_reporting.h"

#include <cstdio>

#include "engine/base/interrupt.h"

namespace splatray {

LoadedScene load_reporting(const Request& request, const char* program, ProgressLine& line) {
  LoadListener listener;
  listener.progress = [&line](const char* stage, double share) {
    line.show(stage, share);
    return !interrupted();
  };
  listener.note = [&](const std::string& note) {
    line.clear();
    if (!request.output.quiet) std::fprintf(stderr, "%s: note: %s\n", program, note.c_str());
  };
  LoadedScene loaded = load_scene(request, listener);
  line.clear();
  return loaded;
}

}  // namespace splatray
