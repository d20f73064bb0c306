/// splatray-view: a scene in a window.
#include "app/library/picture/series/run_files.h"
#include "app/view/view_options.h"
#include "app/view/viewer.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/file/file_roles.h"

namespace {

using namespace splatray;

int view(int argc, char** argv) {
  const auto start = ViewStats::Clock::now();
  const std::optional<Request> request = parse_view_options(argc, argv);
  if (!request) return static_cast<int>(ExitCode::done);
  note_inputs(*request);
  if (!request->output.stats_json.empty()) claim_output(request->output.stats_json);
  catch_interrupts();
  Viewer viewer(*request, start);
  viewer.run();
  stop_if_interrupted();
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) { return splatray::run_main("splatray-view", view, argc, argv); }
