#include "app/view/view_options.h"

#include "app/cli/options.h"
#include "app/view/model/keys.h"

namespace splatray {

std::optional<Request> parse_view_options(int argc, char** argv) {
  OptionList list("Shows a scene of splats in a window.", "splatray-view");
  GivenFields given;
  add_fields(list, DOOR_VIEW, "SCENE", given);
  list.set_group(group_title(FieldGroup::files));
  list.add_answer("--keys", keys_markdown, "print the table of keys as Markdown");
  HelpTable keys{"Keys and mouse"};
  for (const KeyRow& row : key_rows()) keys.rows.emplace_back(row.keys, row.does);
  list.add_table(std::move(keys));
  list.set_examples(
      {{"splatray-view survey.laz", "orbit, light, materials; S saves the picture, H shows all keys"},
       {"splatray-view room.e57 --view inside --resolution 1600x900",
        "from the scanner, in a window of this size"},
       {"splatray-view statue.ply --material gold --environment sky.hdr", "a mesh of gold under a sky"}});
  if (!list.parse(argc, argv)) return {};
  Request request;
  request.view.width = request.view.height = 0;
  assign(request, given, DOOR_VIEW);
  return request;
}

}  // namespace splatray
