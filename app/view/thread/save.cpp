#include "app/view/thread/save.h"

#include "app/library/picture/picture_file.h"
#include "app/library/picture/series/make.h"
#include "app/library/picture/series/run_files.h"
#include "app/library/shot/picture_lights.h"
#include "app/library/shot/resolve.h"
#include "app/library/shot/scene_source.h"
#include "app/library/user_folders.h"
#include "app/view/model/document_request.h"

namespace splatray {
namespace {

/// Makes the shot's pictures; returns a sentence about them.
std::string save_shot(Shot shot, SceneOnDevice& shown, const SceneFacts& facts,
                      const SaveProgress& progress) {
  require_no_inputs_replaced(shot.request, shot.frames);
  require_outputs_writable(shot.request);
  require_picture_memory(shot);
  expose(shot, shown, facts);
  const auto pictures = static_cast<double>(shot.frames.size());
  const SequenceListener listener{[&](const SequenceFrame& frame, std::size_t before, double share) {
                                    return progress({"saving " + frame.output.filename().string(),
                                                     (static_cast<double>(before) + share) / pictures});
                                  },
                                  [](const std::string&) {}, [](const FailedPicture&) {}};
  const SequenceRecord record = make(shot, shown, listener);
  require_all_made(record);
  const std::string saved = "saved '" + shot.request.output.path.string() + "'";
  if (!shot.is_sequence()) return saved;
  const std::string all = std::to_string(shot.frames.size()) + " pictures";
  if (record.skipped == 0) return saved + ": " + all;
  return saved + ": " + std::to_string(record.made.size()) + " of " + all + ", the others were there";
}

/// The scene shown of files in levels is what the window needs: what is saved has one of its own.
std::string save_from_levels(const Request& request, const Device& device, const SaveProgress& progress) {
  const LoadedScene loaded = load_scene(request, {[&](const char* stage, double share) {
                                                    return progress({stage, share});
                                                  },
                                                  {}});
  Shot shot = resolve(request, loaded.scene, loaded.facts);
  SceneOnDevice shown(device, {.pipeline_folder = user_cache_folder()});
  shown.show_environment(shot.environment);
  shown.open(loaded.scene);
  return save_shot(std::move(shot), shown, loaded.facts, progress);
}

}  // namespace

SaveJob save_job(const Document& document, const Request& asked) {
  return {document, saved_request(document, asked)};
}

std::string save_pictures(const SaveJob& job, LiveScene& live, const SaveProgress& progress) {
  const Document& document = job.document;
  SceneFacts facts = document.loaded->facts;
  if (facts.overview) return save_from_levels(job.request, live.shown().device(), progress);
  live.match(document, ViewMode::shaded);
  facts.legend = live.legend();
  return save_shot(resolve(job.request, live.scene(), facts), live.shown(), facts, progress);
}

}  // namespace splatray
