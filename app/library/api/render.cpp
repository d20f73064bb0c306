#include <cstring>

#include "app/library/api/guard.h"
#include "app/library/api/request_impl.h"
#include "app/library/api/scene_impl.h"
#include "app/library/image_file.h"
#include "app/library/picture/make_picture.h"
#include "app/library/picture/picture_file.h"
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
  return request;
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
  if (needs_noise(request.output.aovs)) image.error = made.error;
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
    const std::shared_ptr<Scene::Impl> impl = SceneAccess::impl(scene);
    const splatray::Scene& inner = impl->loaded.scene;
    const splatray::Request request = request_for(impl->asked, RequestAccess::inner(asked));
    ObjectLooks objects = choose_objects(inner, request);
    Shot shot = resolve(request, inner, impl->loaded.facts);
    require_memory(2 * made_image_bytes(shot), "a picture of " + std::to_string(shot.view.width) + "x" +
                                                   std::to_string(shot.view.height) + " pixels");
    // Refuses a camera and lights before a device is opened.
    (void)make_frame_params(inner, {shot.view.camera, shot.view.width, shot.view.height}, shot.settings);
    if (const auto defect = find_look_defect(objects, resolve_lights(inner, request, shot.view.camera)))
      refuse(defect->found, defect->expected);
    return impl->on_device(relay, [&](SceneOnDevice& shown) {
      shown.show_environment(shot.environment);
      shown.show_objects(std::move(objects));
      expose(shot, shown);
      const auto progressed = [&relay](double share) { return relay("tracing", share); };
      return outer_image(make_picture(shot, shown, shot.view.camera, progressed).image, shot);
    });
  });
}

Image make_picture(const Request& request, const Progress& progress) {
  const splatray::Request& inner = RequestAccess::inner(request);
  return render(open(inner.source.inputs, request, progress), request, progress);
}

}  // namespace splatray::api
