#include "app/view/view_options.h"

#include "app/cli/option_types.h"
#include "app/view/model/keys.h"

namespace splatray {

std::optional<ViewOptions> parse_view_options(int argc, char** argv) {
  ViewOptions options;
  options.picture.width = options.picture.height = 0;
  OptionList list("Shows a scene of splats in a window.", "splatray-view");
  list.add_answer(
      "--version", [] { return SPLATRAY_VERSION; }, "print the version");
  list.add_answer("--keys", keys_markdown, "print the table of keys as Markdown");
  list.set_footer("\n" + keys_text());
  add_scene_options(list, options.scene);
  list.add_value(
      "--exposure",
      [&options](const std::string& text) {
        options.exposure_ev = read_number<double>("--exposure", text, -60.0, 60.0);
      },
      {}, "brightness in stops; default: what is seen of a scan becomes middle grey, else 0", "EV");
  add_path(list, "--stats-json", options.stats_json,
           "write times, rates, counts and errors here, whenever the picture rests and at the end");
  add_picture_options(list, options.picture);
  if (!list.parse(argc, argv)) return {};
  options.scene.params.seed = options.picture.settings.seed;
  return options;
}

}  // namespace splatray
