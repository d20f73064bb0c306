/// The table of fields in the viewer: each has a control, and what is shown or saved asks for it.
#include "app/library/request/fields.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "app/view/model/document_request.h"
#include "app/view/thread/save.h"
#include "app/view/ui/field_controls.h"
#include "tests/view/gui_driver.h"
#include "tests/view/live_documents.h"

namespace splatray {
namespace {

/// Texts that are not the defaults, for fields whose kind does not give one.
const std::map<std::string, std::string> TEXTS = {{"inputs", "other.ply"},
                                                  {"data-path", "folder"},
                                                  {"sensor", "1,2,3"},
                                                  {"trajectory", "track.txt"},
                                                  {"columns", "x,y,z"},
                                                  {"attributes", "a,b"},
                                                  {"smooth", "0.25"},
                                                  {"color-by", "normal"},
                                                  {"color-range", "0,1"},
                                                  {"hide-class", "7"},
                                                  {"hide-scan", "1"},
                                                  {"object", "0:mirror=0.25"},
                                                  {"light", "1,2,3,4,5,6,0.5"},
                                                  {"sun", "0,0,1,4,5,6,0.5"},
                                                  {"area-light", "0,0,3,0,0,0,2,1,4,5,6"},
                                                  {"lights", "none"},
                                                  {"environment", "black"},
                                                  {"sun-at", "2026-06-21T15:00+02:00,48.1,11.6"},
                                                  {"background", "0.5,0.25,2"},
                                                  {"keep-box", "-1,-1,-1,1,2,3,30"},
                                                  {"drop-box", "0.25,0,0,1,2,3"},
                                                  {"cut", "0,0,1,0,0,-1"},
                                                  {"resolution", "33x17"},
                                                  {"eye", "1,2,3"},
                                                  {"target", "0.5,0,0"},
                                                  {"up", "0,0,1"},
                                                  {"camera-up", "0,0,1"},
                                                  {"fov", "20"},
                                                  {"lens-shift", "0.25,0.5"},
                                                  {"crop", "1,2,3,4"},
                                                  {"tile", "1/2"},
                                                  {"device", "cpu"},
                                                  {"output", "a.exr"},
                                                  {"orbit", "7x2"},
                                                  {"aov", "depth"},
                                                  {"camera-path", "path.json"},
                                                  {"frames", "0-3"},
                                                  {"exposure", "-0.75"},
                                                  {"lod", "0.5"},
                                                  {"max-memory", "4194304K"},
                                                  {"delta", "0.25"}};

/// Fields that become others when a scene is shown, and why.
const std::map<std::string, std::string> RESOLVED = {
    {"camera", "becomes eye, target, camera-up and fov"},
    {"view", "becomes a camera"},
    {"sun-at", "becomes an environment"},
    {"object", "becomes all changes of its object, by its name"},
    {"area-light", "becomes a --light of the kind rectangle"},
    {"device", "is the program's: the window has one"},
    {"stats-json", "is the program's"},
};

/// A text of the field that is not its default.
std::string other_text(const Field& field) {
  if (const auto found = TEXTS.find(field.name); found != TEXTS.end()) return found->second;
  const std::vector<FieldText> now = field.write(Request{});
  if (field.kind == FieldKind::flag) return !now.empty() && now.front().text == "on" ? "off" : "on";
  if (field.kind == FieldKind::whole) return std::to_string(static_cast<int>(field.least) + 3);
  if (field.kind == FieldKind::number) return field.most >= 0.5 ? "0.5" : "0";
  return field.value.substr(field.value.rfind('|') + 1);  // the last of a choice
}

Document loaded(const Scene& scene) {
  Request request;
  request.source.inputs = {"discs.ply"};
  return first_document(scene, facts_of(scene), request);
}

TEST(ViewFields, WhatIsAskedForIsWhatIsShownAndSaved) {
  const Scene scene = disc_scene(1);
  for (const Field& field : fields()) {
    if (!field.in(DOOR_VIEW) || RESOLVED.contains(field.name)) continue;
    const std::string text = other_text(field);
    Request asked;
    const bool of_camera =
        field.name == "target" || field.name == "camera-up" || field.name == "ortho-height";
    std::vector<FieldText> values = {{"inputs", "discs.ply"}, {field.name, text}};
    if (of_camera) values.push_back({"eye", "1,2,3"});
    if (field.name == "inputs") values.erase(values.begin());
    assign(asked, values, DOOR_VIEW);
    const Request made = field.is(OF_FILES)
                             ? save_job(loaded(scene), asked).request
                             : request_of(first_document(scene, facts_of(scene), asked), 320, 200);
    EXPECT_EQ(texts_of(field, made), std::vector{text}) << field.name;
  }
}

/// Where all_fields has a control for the field: of a repeated one, for one value more than there are.
ControlPath path_of(const Field& field, const Document& document) {
  ControlPath path = {std::string(group_title(field.group))};
  if (field.repeated) {
    const Request request = request_of(document, 1, 1);
    path.push_back(static_cast<int>(family_values(field, request).size()));
  }
  path.push_back(field.name);
  return path;
}

void expect_there(GuiDriver& gui, const std::string& window, const std::vector<ControlPath>& paths) {
  const std::vector<bool> there = gui.are_there(window, paths);
  for (std::size_t i = 0; i < paths.size(); ++i)
    EXPECT_TRUE(there[i]) << "no control for " << std::get<std::string>(paths[i].back());
}

constexpr float TALL_PX = 4000.0F;

TEST(ViewFields, EachHasAControl) {
  GuiDriver gui(1280, TALL_PX);
  gui.document = disc_document(disc_scene(1));
  gui.click("##column", {"All options"});
  std::vector<ControlPath> seen, saved;
  std::set<FieldGroup> opened;
  for (const Field& field : fields()) {
    if (!field.in(DOOR_VIEW) || field.group == FieldGroup::files) continue;
    if (field.is(OF_FILES)) {
      if (field.is(HAS_OWN_CONTROL)) continue;
      saved.push_back({field.name});
      continue;
    }
    if (opened.insert(field.group).second) gui.click("##column", {group_title(field.group)});
    seen.push_back(path_of(field, gui.document));
  }
  expect_there(gui, "##column", seen);
  gui.state.show_record = true;
  expect_there(gui, "Record", saved);
  EXPECT_FALSE(gui.are_there("Record", {{"no such field"}}).front());
}

TEST(ViewFields, AControlAsksForTheChange) {
  GuiDriver gui(1280, TALL_PX);
  gui.document = disc_document(disc_scene(1));
  gui.click("##column", {"All options"});
  gui.click("##column", {"Quality"});
  const Requests requests = gui.click("##column", {"Quality", "shadows"});
  ASSERT_TRUE(requests.change.has_value());
  EXPECT_FALSE(requests.change->settings.shadows);
}

}  // namespace
}  // namespace splatray
