#include <cstring>

#include "app/library/api/guard.h"
#include "app/library/api/request_impl.h"
#include "app/library/api/scene_impl.h"
#include "app/library/image_file.h"
#include "app/library/picture/lod_error.h"
#include "app/library/picture/make_picture.h"
#include "app/library/picture/picture_file.h"
#include "app/library/picture/series/make.h"
#include "app/library/picture/series/run_files.h"
#include "app/library/shot/lights.h"
#include "app/library/shot/picture_lights.h"
#include "app/library/shot/resolve.h"
#include "engine/base/memory.h"
#include "engine/scene/scene_check.h"

namespace splatray::api {
namespace {

/// What is asked for, and for what that leaves open what was asked for when the scene was opened, which has its colours since.
splatray::Request request_for(const splatray::Request& opened, const splatray::Request& asked) {
  splatray::Request request = asked;
  if (!asked.look.style && asked.look.environment.empty() && !asked.look.lights)
    request.look.style = opened.look.style;
  if (asked.look.environment.empty()) request.look.environment = opened.look.environment;
  if (!asked.view.eye && asked.view.viewpoint == Viewpoint::automatic && !asked.look.up)
    request.view.viewpoint = opened.view.viewpoint;
  request.look.attributes = opened.look.attributes;
  if (!opened.source.inputs.empty()) request.source = opened.source;
  return request;
}

/// The scene, or of files in levels the one that the request's pictures need.
std::shared_ptr<Scene::Impl> scene_for(const std::shared_ptr<Scene::Impl>& opened,
                                       const splatray::Request& asked, ProgressRelay& relay) {
  if (!opened->loaded.facts.overview) return opened;
  const splatray::Request request = request_for(opened->asked, asked);
  auto other = std::make_shared<Scene::Impl>();
  other->loaded = load_needed(request, in_levels(request), opened->loaded.facts, {std::ref(relay), {}},
                              opened->loaded.nodes);
  if (other->loaded.nodes == opened->loaded.nodes) return opened;
  other->asked = opened->asked;
  return other;
}

/// A shot, and what the scene's objects look like in it.
struct Resolved {
  Shot shot;
  std::vector<splatray::Material> materials;
};

/// Refuses a camera and lights before a device is opened.
Resolved resolve_for(const Scene::Impl& impl, const splatray::Request& asked) {
  const splatray::Scene& scene = impl.loaded.scene;
  const splatray::Request request = request_for(impl.asked, asked);
  Resolved resolved{{}, choose_materials(scene, request)};
  const Shot& shot = resolved.shot = resolve(request, scene, impl.loaded.facts);
  (void)make_frame_params(scene, {shot.view.camera, shot.view.width, shot.view.height}, shot.settings);
  if (const auto defect =
          find_look_defect(resolved.materials, resolve_lights(scene, request, shot.view.camera)))
    refuse(defect->found, defect->expected);
  return resolved;
}

void show(Resolved& resolved, const SceneFacts& facts, SceneOnDevice& shown) {
  shown.show_environment(resolved.shot.environment);
  shown.show_materials(std::move(resolved.materials));
  expose(resolved.shot, shown, facts);
}

std::vector<Choice> choices_of(const Shot& shot) {
  std::vector<Choice> choices;
  for (const FieldText& choice : shot.choices) choices.push_back({choice.name, choice.text});
  return choices;
}

/// The interface's image; its channels where the request asks for any.
Image outer_image(const splatray::Image& made, const Shot& shot) {
  const splatray::Request& request = shot.request;
  Image image;
  image.width = made.width;
  image.height = made.height;
  image.pixels.resize(made.rgba.size());
  static_assert(sizeof(vec4) == sizeof(std::array<float, 4>));
  std::memcpy(image.pixels.data(), made.rgba.data(), made.rgba.size() * sizeof(vec4));
  image.choices = choices_of(shot);
  image.lod_error = shot.lod_error;
  if (needs(request.output.aovs, AovSource::noise)) image.error = made.error;
  for (const vec4& albedo : made.albedo) image.albedo.push_back(array(vec3(albedo)));
  image.exposure = request.look.exposure_ev.value_or(0.0);
  image.tone = TONE_NAMES[static_cast<std::size_t>(resolve_tone(request))];
  if (!request.settings.aov) return image;
  for (const AovPixel& pixel : made.aov) {
    image.depth.push_back(pixel.z);
    image.normal.push_back(array(pixel.normal));
    image.object.push_back(pixel.object == NO_OBJECT ? -1 : static_cast<std::int32_t>(pixel.object));
  }
  return image;
}

}  // namespace

Image render(const Scene& scene, const Request& asked, const Progress& progress) {
  return guarded(progress, [&](ProgressRelay& relay) {
    const splatray::Request& inner = RequestAccess::inner(asked);
    const std::shared_ptr<Scene::Impl> impl = scene_for(SceneAccess::impl(scene), inner, relay);
    Resolved resolved = resolve_for(*impl, inner);
    Shot& shot = resolved.shot;
    if (shot.is_sequence() || shot.is_orbit() || shot.sheet_set() != nullptr)
      refuse("a sequence of pictures or a page", "one picture; make() writes the others");
    require_memory(2 * made_image_bytes(shot), "a picture of " + std::to_string(shot.view.width) + "x" +
                                                   std::to_string(shot.view.height) + " pixels");
    return impl->on_device(relay, [&](SceneOnDevice& shown) {
      show(resolved, impl->loaded.facts, shown);
      measure_lod_error(shot, shown, impl->loaded, [](const std::string&) {});
      const auto progressed = [&relay](double share) { return relay("tracing", share); };
      return outer_image(make_picture(shot, shown, shot.view.camera, progressed).image, shot);
    });
  });
}

Made make(const Scene& scene, const Request& asked, const Progress& progress) {
  return guarded(progress, [&](ProgressRelay& relay) {
    const splatray::Request& inner = RequestAccess::inner(asked);
    const std::shared_ptr<Scene::Impl> impl = scene_for(SceneAccess::impl(scene), inner, relay);
    Resolved resolved = resolve_for(*impl, inner);
    Shot& shot = resolved.shot;
    if (shot.request.output.path.empty()) refuse("no \"output\"", "the name of a file");
    require_no_inputs_replaced(shot.request, shot.frames);
    require_outputs_writable(shot.request);
    require_picture_memory(shot);
    return impl->on_device(relay, [&](SceneOnDevice& shown) {
      show(resolved, impl->loaded.facts, shown);
      Made made{{}, choices_of(shot), shot.notes};
      measure_lod_error(shot, shown, impl->loaded,
                        [&made](const std::string& note) { made.notes.push_back(note); });
      const auto pictures = static_cast<double>(shot.frames.size());
      const SequenceRecord record = splatray::make(
          shot, shown,
          {[&](const SequenceFrame&, std::size_t before, double share) {
             return relay("tracing", (static_cast<double>(before) + share) / pictures);
           },
           [&made](const std::string& note) { made.notes.push_back(note); }, [](const FailedPicture&) {}});
      require_all_made(record);
      for (const SequenceFrame& frame : shot.frames) made.files.push_back(frame.output);
      return made;
    });
  });
}

Image make_picture(const Request& request, const Progress& progress) {
  const splatray::Request& inner = RequestAccess::inner(request);
  const Request asked = inner.source.lod ? request : Request(request).set("lod", 1);
  return render(open(inner.source.inputs, asked, progress), asked, progress);
}

}  // namespace splatray::api
