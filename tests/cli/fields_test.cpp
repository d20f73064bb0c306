/// The table of fields: each is in every door, or says why not.
#include "app/library/request/fields.h"

#include <gtest/gtest.h>

#include <set>

#include "app/library/request/command_line.h"
#include "app/library/request/request_json.h"
#include "engine/base/error.h"

namespace splatray {
namespace {

TEST(Fields, HaveOneNameASentenceAndTheirDoors) {
  std::set<std::string> names, old_names;
  for (const Field& field : fields()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name << " is there twice";
    EXPECT_GT(field.help.size(), 10U) << field.name;
    EXPECT_EQ(field.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos) << field.name;
    for (const FieldDoors door : {DOOR_RENDER, DOOR_VIEW, DOOR_LIBRARY}) {
      EXPECT_TRUE(field.in(door) || !field.why_not.empty()) << field.name << " is not in door " << door;
      EXPECT_EQ(find_field(field.name, door), field.in(door) ? &field : nullptr) << field.name;
    }
    for (const std::string& old : field.old_names) EXPECT_TRUE(old_names.insert(old).second) << old;
    EXPECT_EQ(field.repeated, static_cast<bool>(field.clear)) << field.name;
    const bool is_a_number = field.kind == FieldKind::number || field.kind == FieldKind::whole;
    EXPECT_EQ(is_a_number, field.least < field.most) << field.name;
  }
}

/// What a field says of a request is what makes the request say it.
TEST(Fields, ReadWhatTheyWrite) {
  Request request;
  assign(request,
         {{"sun", "0,0,1"},
          {"light", "1,2,3,4,5,6,0.5"},
          {"area-light", "0,0,3,0,0,0,2,1"},
          {"object", "a:mirror=0.25"},
          {"inputs", "a.ply"},
          {"inputs", "b.ply"},
          {"data-path", "c"},
          {"eye", "1,2,3"},
          {"lens-shift", "0.25,-0.5"},
          {"pixel-aspect", "1.25"},
          {"exposure", "0.5"},
          {"frames", "0-3"},
          {"crop", "1,2,3,4"},
          {"tile", "1/2"},
          {"color-range", "0,1"},
          {"hide-class", "7,18"},
          {"delta", "0.25"},
          {"smooth", "0.125"}},
         DOORS_ALL);
  for (const Field& field : fields()) {
    if (!field.write) continue;
    const std::vector<FieldText> texts = field.write(request);
    Request again = request;
    if (!texts.empty()) assign(again, texts, DOORS_ALL);
    if (field.adds) again.look.objects = request.look.objects;
    EXPECT_EQ(field.write(again), texts) << field.name;
  }
  Request whole;
  assign(whole, changed_values(request), DOORS_ALL);
  EXPECT_EQ(whole, request);
}

TEST(Fields, AreReadWhateverTheOrder) {
  const std::vector<FieldText> values = {{"samples", "4"}, {"up", "0,0,1"},    {"camera-up", "0,1,0"},
                                         {"sun", "0,0,1"}, {"light", "1,2,3"}, {"samples", "9"},
                                         {"eye", "1,2,3"}};
  Request forwards, backwards;
  assign(forwards, values, DOOR_RENDER);
  assign(backwards,
         {{"eye", "1,2,3"},
          {"samples", "4"},
          {"camera-up", "0,1,0"},
          {"up", "0,0,1"},
          {"sun", "0,0,1"},
          {"light", "1,2,3"},
          {"samples", "9"}},
         DOOR_RENDER);
  EXPECT_EQ(forwards, backwards);
  EXPECT_EQ(forwards.settings.samples, 9U) << "the last holds";
  EXPECT_EQ(forwards.look.lights->size(), 2U);
  assign(forwards, {{"sun", "1,0,0"}}, DOOR_RENDER);
  EXPECT_EQ(forwards.look.lights->size(), 1U) << "lights given later take the place of those there were";
}

TEST(Fields, RefuseInASentenceWithTheDoorsSpelling) {
  Request request;
  try {
    assign(request, {{"samples", "many"}}, DOOR_RENDER, {"--", " (see --help)"});
    ADD_FAILURE() << "taken";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "--samples: found 'many', expected a whole number from 1 to 65536 (see --help)");
  }
  EXPECT_THROW(assign(request, {{"no-such-field", "1"}}, DOOR_RENDER), Error);
  EXPECT_THROW(assign(request, {{"stats-json", "a.json"}}, DOOR_LIBRARY), Error) << "of another door";
  EXPECT_THROW(assign(request, {{"camera", "no such file"}}, DOOR_RENDER), Error);
}

TEST(Fields, OldNamesStillHold) {
  const Request request = parse_command_line(
      "splatray-render a.ply --env white --max-bounces=3 --points 5 --ortho=2 --eye 1,2,3");
  EXPECT_EQ(request.look.environment, "white");
  EXPECT_EQ(request.settings.max_bounces, 3U);
  EXPECT_EQ(request.source.params.samples, 5U);
  EXPECT_EQ(request.view.ortho_height, 2.0);
  EXPECT_EQ(find_field("samples", DOOR_PREPROCESS)->name, "mesh-points");
  EXPECT_EQ(find_field("samples", DOOR_RENDER)->name, "samples");
}

TEST(RequestJson, RefusesWhatIsNoRequest) {
  for (const char* text : {"", "[]", "{\"samples\": []}", "{\"samples\": \"many\"}", "{\"nothing\": 1}",
                           "{\"lights\": 3}", "{\"lights\": [\"sun\"]}", "{\"lights\": [\"lamp=1,2,3\"]}",
                           "{\"object\": [1]}", "{\"samples\": 1e999}", "{\"resolution\": [64, [48]]}"}) {
    try {
      (void)read_request_text(text, "the test");
      ADD_FAILURE() << "taken: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable) << text;
      EXPECT_NE(std::string(error.what()).find("the test"), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(read_request_text("{}", "the test"), Request{});
  const Request dark = read_request_text("{\"lights\": []}", "the test");
  ASSERT_TRUE(dark.look.lights.has_value());
  EXPECT_TRUE(dark.look.lights->empty());
}

/// The sentence that refuses a request.
std::string request_refusal(const std::string& text) {
  try {
    (void)read_request_text(text, "the test");
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

TEST(RequestJson, SaysWhereItIsWrongInOurWords) {
  EXPECT_EQ(
      request_refusal("{\"samples\": 4,\n  \"seed\" 5}"),
      "cannot read the request in the test: found no JSON at line 2, column 10, expected an object of names "
      "and values");
  EXPECT_NE(request_refusal("{\"samples\": 4,\n").find("JSON that ends in its middle, at line 1, column 15"),
            std::string::npos);
  EXPECT_NE(request_refusal(" \n").find("an empty text"), std::string::npos);
  EXPECT_NE(request_refusal("{\"samples\": 1e999}").find("a number beyond float64 at line 1, column 17"),
            std::string::npos);
  EXPECT_NE(request_refusal("{\"samples\": 4, \"seed\": 1, \"samples\": 5}").find("'samples' twice"),
            std::string::npos);
  for (const char* text :
       {"{\"samples\": 4,\n", "nul", "{\"a\": \"\xff\"}", "[1", "\"\\x\"", "{\"a\": 1e999}"})
    EXPECT_EQ(request_refusal(text).find("exception"), std::string::npos) << request_refusal(text);
}

TEST(RequestJson, TakesArraysForWhatHasParts) {
  const Request parts = read_request_text(
      R"({"inputs": "a.ply", "resolution": [64, 48], "tile": [1, 4], "eye": [1, -2, 0.5], "sun": [0, -1, 1],
          "light": [[0, 0, 3], "1,2,3"], "hide-class": [7, 18], "aov": ["depth", "id"]})",
      "the test");
  Request whole;
  assign(whole,
         {{"inputs", "a.ply"},
          {"resolution", "64x48"},
          {"tile", "1/4"},
          {"eye", "1,-2,0.5"},
          {"sun", "0,-1,1"},
          {"light", "0,0,3"},
          {"light", "1,2,3"},
          {"hide-class", "7,18"},
          {"aov", "depth,id"}},
         DOORS_ALL);
  EXPECT_EQ(parts, whole);
}

}  // namespace
}  // namespace splatray
