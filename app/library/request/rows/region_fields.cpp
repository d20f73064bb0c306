#include "app/library/request/fields.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

constexpr FieldGroup REGION = FieldGroup::region;

TurnedBox read_box(const std::string& text) {
  auto numbers = split_numbers(text, ',', 6);
  if (numbers.empty()) numbers = split_numbers(text, ',', 7);
  if (numbers.empty()) throw Expected{"six or seven numbers such as 0,0,0,10,8,2.5 or 0,0,0,10,8,2.5,30"};
  TurnedBox box{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
  if (numbers.size() == 7) box.turn_deg = numbers[6];
  if (!glm::all(glm::lessThan(box.low, box.high))) throw Expected{"X0 < X1, Y0 < Y1 and Z0 < Z1"};
  return box;
}

std::string box_text(const std::optional<TurnedBox>& box) {
  if (!box) return {};
  const std::string corners = number_text(box->low) + "," + number_text(box->high);
  return box->turn_deg == 0.0 ? corners : corners + "," + number_text(box->turn_deg);
}

template <class Member>
Field box_row(std::string name, Member member, std::string help) {
  return value_row(
      std::move(name), REGION, "X0,Y0,Z0,X1,Y1,Z1[,TURN]", std::move(help),
      [=](Request& request, const std::string& text) { member(request) = read_box(text); },
      [=](const Request& request) { return box_text(member(request)); });
}

Field cut_row() {
  Field row = value_row(
      "cut", REGION, "X,Y,Z,NX,NY,NZ",
      "only the side of the plane through X,Y,Z that NX,NY,NZ points to; repeatable, 16 planes in all, of "
      "which --keep-box takes six",
      [](Request& request, const std::string& text) {
        const auto numbers = split_numbers(text, ',', 6);
        if (numbers.empty()) throw Expected{"six numbers such as 0,0,1.2,0,0,-1"};
        const HalfSpace half{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
        if (half.normal == glm::dvec3(0.0)) throw Expected{"a direction NX,NY,NZ other than 0,0,0"};
        request.view.region.cuts.push_back(half);
      },
      {});
  row.repeated = true;
  row.clear = [](Request& request) { request.view.region.cuts.clear(); };
  row.write = [](const Request& request) {
    std::vector<FieldText> texts;
    for (const HalfSpace& half : request.view.region.cuts)
      texts.push_back({"cut", number_text(half.point) + "," + number_text(half.normal)});
    return texts;
  };
  return row;
}

}  // namespace

std::vector<Field> region_fields() {
  return {box_row("keep-box", MEMBER(view.region.keep_box),
                  "only what is in this box, in the file's coordinates; TURN: degrees about the up axis "
                  "through its middle, counter-clockwise seen from above"),
          box_row("drop-box", MEMBER(view.region.drop_box), "all but what is in this box"), cut_row(),
          choice_row<std::optional<bool>>(
              "cut-light", REGION, MEMBER(view.region.light_kept),
              {{"auto", std::nullopt}, {"all", false}, {"kept", true}},
              "whether what the region hides still casts light and shadow (all) or not (kept); default auto: "
              "all, for sheets kept"),
          switch_row(
              "look-in", REGION, MEMBER(view.look_in),
              "hide the near walls and ceilings of a room, as --view dollhouse does; for two-sided scenes, "
              "such as scans")};
}

}  // namespace splatray
