#include "app/view/view_options.h"

#include "app/cli/options.h"
#include "app/view/model/keys.h"

namespace splatray {

std::optional<Request> parse_view_options(int argc, char** argv) {
  OptionList list("Shows a scene of splats in a window.", "splatray-view");
  GivenFields given;
  add_fields(list, DOOR_VIEW, "SCENE", given);
  list.set_group(group_title(FieldGroup::files));
  list.add_answer(
      "--version", [] { return SPLATRAY_VERSION; }, "print the version");
  list.add_answer("--keys", keys_markdown, "print the table of keys as Markdown");
  list.set_footer("\n" + keys_text());
  if (!list.parse(argc, argv)) return {};
  Request request;
  request.view.width = request.view.height = 0;
  assign(request, given, DOOR_VIEW);
  return request;
}

}  // namespace splatray
