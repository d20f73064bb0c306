#include <cstring>

#include "app/library/api/guard.h"
#include "app/library/api/request_impl.h"
#include "app/library/api/scene_impl.h"
#include "app/library/image_file.h"
#include "app/library/picture/make_picture.h"
#include "app/library/picture/picture_file.h"
#include "engine/base/memory.h"
#include "engine/scene/look_style.h"
#include "engine/scene/scene_check.h"
#include "engine/scene/surface.h"

namespace splatray::api {
namespace {

/// Whether objects are shown of other materials than their own; one that is hidden, or no longer, is of the same.
bool changes_materials(const splatray::Scene& scene, const ObjectLooks& shown) {
  std::vector<splatray::Material> materials = shown.materials;
  for (std::size_t i = 0; i < materials.size(); ++i)
    materials[i].flags =
        (materials[i].flags & ~MATERIAL_HIDDEN) | (scene.materials[i].flags & MATERIAL_HIDDEN);
  return !same_looks({scene.materials, surfaces_of(scene)}, {materials, shown.surfaces});
}

/// What is asked for, and for what that leaves open what suits the scene as it was opened.
splatray::Request request_for(const LoadedScene& loaded, const splatray::Request& asked,
                              const ObjectLooks& shown) {
  const splatray::Request& suited = loaded.request;
  splatray::Request request = asked;
  if (!request.look.style && asked.look.environment.empty() && !asked.look.lights)
    request.look.style = suited.look.style;
  if (!request.look.style) request.look.style = choose_look(loaded.scene, request);
  if (!asked.look.style && changes_materials(loaded.scene, shown) &&
      !look_style(*request.look.style).surfaces)
    request.look.style = LOOK_LIT;
  if (!request.view.eye && request.view.viewpoint == Viewpoint::automatic && !request.look.up)
    request.view.viewpoint = suited.view.viewpoint;
  request.settings.cutaway = request.view.look_in || request.view.viewpoint == Viewpoint::dollhouse;
  request.look.attributes = suited.look.attributes;
  return request;
}

/// The interface's image; its channels where the request asks for any.
Image outer_image(const splatray::Image& made, const splatray::Request& request) {
  Image image;
  image.width = made.width;
  image.height = made.height;
  image.pixels.resize(made.rgba.size());
  static_assert(sizeof(vec4) == sizeof(std::array<float, 4>));
  std::memcpy(image.pixels.data(), made.rgba.data(), made.rgba.size() * sizeof(vec4));
  if (needs_noise(request.output.aovs)) image.error = made.error;
  image.exposure = request.look.exposure_ev.value_or(0.0);
  image.tone = TONE_NAMES[static_cast<std::size_t>(choose_tone(request))];
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
    ObjectLooks objects = choose_objects(inner, RequestAccess::inner(asked));
    splatray::Request request = request_for(impl->loaded, RequestAccess::inner(asked), objects);
    require_consistent(request);
    require_memory(2 * made_image_bytes(request), "a picture of " + std::to_string(request.view.width) + "x" +
                                                      std::to_string(request.view.height) + " pixels");
    const splatray::Camera camera = choose_camera(inner, request);
    // Refuses a camera and lights before a device is opened.
    (void)make_frame_params(inner, {camera, request.view.width, request.view.height},
                            choose_settings(inner, request));
    if (const auto defect = find_look_defect(objects, choose_lights(inner, request, camera)))
      refuse(defect->found, defect->expected);
    return impl->on_device(relay, [&](SceneOnDevice& shown) {
      const std::string& environment = request.look.environment;
      shown.show_environment(environment.empty() ? impl->loaded.environment_name : environment);
      shown.show_objects(std::move(objects));
      if (suits_exposure(inner, request))
        request.look.exposure_ev = preview_exposure_ev(request, shown, camera);
      const auto progressed = [&relay](double share) { return relay("tracing", share); };
      return outer_image(make_picture(request, shown, camera, progressed).image, request);
    });
  });
}

Image make_picture(const Request& request, const Progress& progress) {
  const splatray::Request& inner = RequestAccess::inner(request);
  return render(open(inner.source.inputs, request, progress), request, progress);
}

}  // namespace splatray::api
