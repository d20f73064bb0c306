#include "app/view/save.h"

#include "app/picture.h"

namespace splatray {

void save_picture(const Document& document, const SaveRequest& request, LiveScene& live, const Context& context,
                  const Tracer::Progress& progress) {
  RenderOptions options;
  options.output = request.path;
  options.picture.settings = document.settings;
  options.picture.settings.samples = request.samples;
  options.picture.width = request.width;
  options.picture.height = request.height;
  options.exposure_ev = document.exposure_ev;
  options.aov_depth = request.aov_depth;
  options.aov_normal = request.aov_normal;
  options.aov_id = request.aov_id;
  options.picture.settings.aov = options.aov_depth || options.aov_normal || options.aov_id;
  require_outputs_writable(options);
  const View view{document.camera, request.width, request.height};
  const Image image = live.tracer().render(view, options.picture.settings, progress);
  write_output(options, image, picture_metadata(options, live.scene(), view, context));
}

}  // namespace splatray
