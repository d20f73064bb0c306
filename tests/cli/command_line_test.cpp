/// Options as text and back: every field, every bit.
#include "app/library/request/command_line.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <type_traits>

#include "app/library/materials.h"
#include "app/library/request/request_json.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "engine/base/utf8.h"
#include "tests/property/dice.h"

namespace splatray {
namespace {

using testing::Dice;

/// Floats and doubles of all sizes, with all their bits in use.
double number(Dice& dice, double least, double most) { return dice.log_between(least, most); }
float small_float(Dice& dice) { return static_cast<float>(dice.unit()); }
glm::dvec3 vector(Dice& dice) { return dice.in_cube() * number(dice, 1e-9, 1e9); }
glm::vec3 color(Dice& dice) { return {dice.unit(), dice.unit(), dice.unit()}; }

template <typename Value>
void maybe(Dice& dice, std::optional<Value>& target, std::type_identity_t<Value> value) {
  if (dice.chance(0.5)) target = value;
}

/// A path with all that shells, file systems and our own lists treat specially.
std::string odd_text(Dice& dice) {
  const std::string letters = "aZ7 .,:;=/\\'\"$`!*?[]{}()<>|&~#%@^+-_\t\n\xC3\xA9";
  std::string text(1, 'x');
  for (std::uint32_t i = dice.below(12); i > 0; --i)
    text += letters[dice.below(std::uint32_t(letters.size()))];
  return text;
}

/// The same as text, which is UTF-8 behind every door.
std::string odd_words(Dice& dice) { return to_utf8(odd_text(dice)); }

ObjectChange random_object(Dice& dice) {
  ObjectChange object;
  object.object = odd_words(dice);
  const auto say = [&](const char* key, const std::string& value) {
    if (dice.chance(0.5)) object.set(key, value);
  };
  const auto on_off = [&] { return dice.chance(0.5) ? "on" : "off"; };
  say("preset", material_names()[dice.below(std::uint32_t(material_names().size()))]);
  say("diffuse", number_text(color(dice), '/'));
  say("tint", number_text(color(dice), '/'));
  say("specular", number_text(small_float(dice)));
  say("mirror", number_text(small_float(dice)));
  say("shininess", number_text(static_cast<float>(number(dice, 1.0, 1e5))));
  say("ior", number_text(static_cast<float>(number(dice, 0.1, 10.0))));
  say("coat-roughness", number_text(small_float(dice)));
  say("glass", on_off());
  say("two-sided", on_off());
  object.set("hidden", on_off());  // no change at all cannot be written
  return object;
}

LightRequest random_light(Dice& dice) {
  LightRequest asked;
  SceneLight& light = asked.light;
  light.kind = dice.chance(0.5) ? LIGHT_POINT : LIGHT_DIRECTIONAL;
  light.position = vector(dice);
  asked.has_power = dice.chance(0.5);
  if (asked.has_power) light.power = color(dice) * static_cast<float>(number(dice, 1e-6, 1e6));
  if (light.kind == LIGHT_POINT && dice.chance(0.5)) light.range = number(dice, 0.1, 1e3);
  return asked;
}

Request::Source random_source(Dice& dice) {
  Request::Source scene;
  for (std::uint32_t i = dice.below(3) + 1; i > 0; --i) scene.inputs.emplace_back(odd_text(dice) + "b.ply");
  for (std::uint32_t i = dice.below(3); i > 0; --i) scene.data_paths.emplace_back("-" + odd_text(dice));
  scene.threads = dice.below(8);
  scene.scans.strict = dice.chance(0.5);
  scene.scans.ignore_checksums = dice.chance(0.5);
  scene.scans.keep_withheld = dice.chance(0.5);
  if (dice.chance(0.5)) scene.scans.sensor_world = vector(dice);
  if (dice.chance(0.5)) scene.scans.trajectory = odd_text(dice) + ".txt";
  scene.scans.z_scale = dice.chance(0.5) ? 0.3048 : 1.0;
  if (dice.chance(0.5)) scene.scans.columns = odd_words(dice);
  for (std::uint32_t i = dice.below(3); i > 0; --i)
    scene.scans.attributes.push_back("name " + std::to_string(i));
  BuildParams& params = scene.params;
  params.leaf_size = 1 + dice.below(50);
  params.insertion = static_cast<Insertion>(dice.below(3));
  params.probes = 1 + dice.below(64);
  params.radius_rule = static_cast<RadiusRule>(dice.below(2));
  params.radius_scale = number(dice, 1e-3, 1e3);
  params.samples = dice.seed() >> 11U;
  params.normal_fields = dice.chance(0.5);
  params.keep_strays = dice.chance(0.5);
  params.smooth_world = dice.chance(0.3) ? -1.0 : dice.chance(0.3) ? 0.0 : 0.25 * (1 + dice.below(8));
  return scene;
}

Request::Settings random_settings(Dice& dice) {
  Request::Settings settings;
  settings.samples = 1 + dice.below(65536);
  settings.seed = static_cast<std::uint32_t>(dice.seed());
  settings.max_bounces = dice.below(65);
  settings.shadows = dice.chance(0.5);
  settings.blend = dice.below(4);
  settings.kernel = dice.below(2);
  settings.kappa = static_cast<float>(number(dice, 1e-5, 1e5));
  settings.side = dice.below(3);
  settings.order = dice.below(2);
  settings.counters = dice.chance(0.5);
  settings.environment_strength = small_float(dice);
  settings.environment_turn = static_cast<float>(dice.between(-5.0, 5.0));
  return settings;
}

Request random_picture(Dice& dice) {
  Request request;
  request.view.width = 1 + dice.below(32768);
  request.view.height = 1 + dice.below(32768);
  maybe(dice, request.view.eye, vector(dice));
  if (request.view.eye) {
    maybe(dice, request.view.target, vector(dice));
    maybe(dice, request.view.camera_up, vector(dice));
    if (dice.chance(0.5)) request.view.ortho_height = number(dice, 1e-9, 1e9);
  }
  maybe(dice, request.look.up, vector(dice));
  request.view.viewpoint = static_cast<Viewpoint>(dice.below(5));
  maybe(dice, request.view.fov_y_deg, number(dice, 0.01, 179.0));
  request.view.panorama =
      request.view.eye && !request.view.fov_y_deg && request.view.ortho_height == 0.0 && dice.chance(0.5);
  if (dice.chance(0.7)) request.look.lights.emplace();
  for (std::uint32_t i = request.look.lights ? dice.below(4) : 0; i > 0; --i)
    request.look.lights->push_back(random_light(dice));
  for (std::uint32_t i = dice.below(3); i > 0; --i) request.look.objects.push_back(random_object(dice));
  if (dice.chance(0.5)) request.look.environment = odd_text(dice);
  if (dice.chance(0.5)) request.look.attributes.color_by = odd_words(dice);
  const double low = number(dice, 1e-9, 1e9);
  maybe(dice, request.look.attributes.color_range, {low, low + number(dice, 1.0, 1e9)});
  for (std::uint32_t i = dice.below(3); i > 0; --i)
    request.look.attributes.hidden_classes.push_back(dice.below(256));
  for (std::uint32_t i = dice.below(3); i > 0; --i)
    request.look.attributes.hidden_scans.push_back(dice.below(65536));
  if (dice.chance(0.5))
    request.look.material = material_names()[dice.below(std::uint32_t(material_names().size()))];
  request.settings = random_settings(dice);
  maybe(dice, request.settings.asked_delta_world, number(dice, 1e-9, 1e9));
  if (dice.chance(0.5)) request.settings.device = odd_words(dice);
  return request;
}

/// A sequence that goes with the picture's camera, or none.
Request::Output random_sequence(Dice& dice, const Request& request) {
  Request::Output sequence;
  sequence.skip_existing = dice.chance(0.5);
  if (dice.chance(0.5)) return sequence;
  if (request.view.eye || request.view.fov_y_deg)
    sequence.turntable = 1 + dice.below(999999);
  else
    sequence.camera_path = odd_text(dice);
  for (std::uint32_t i = dice.below(4); i > 0; --i) {
    const std::uint32_t first = dice.below(1000);
    sequence.frames.push_back({first, first + dice.below(3) * dice.below(400), 1 + dice.below(5)});
  }
  return sequence;
}

Request random_request(Dice& dice) {
  Request request = random_picture(dice);
  request.source = random_source(dice);
  request.source.params.seed = request.settings.seed;
  request.output = random_sequence(dice, request);
  request.output.path = odd_text(dice) + "/b##.exr";
  request.look.exposure_ev = dice.between(-60.0, 60.0);
  const std::uint32_t centre_rays = dice.below(8), albedo = dice.below(2) << 4U;
  request.output.aovs = centre_rays | albedo;
  request.settings.aov = centre_rays != 0;
  if (dice.chance(0.5)) request.output.stats_json = odd_text(dice);
  if (dice.chance(0.5) && !request.output.many()) request.output.reference = odd_text(dice);
  request.output.reference_threshold = dice.unit();
  request.output.reference_share = dice.unit();
  request.output.reference_limit = dice.unit();
  request.output.list_devices = dice.chance(0.2);
  request.output.quiet = dice.chance(0.5);
  return request;
}

TEST(CommandLine, RandomOptionsComeBackEqual) {
  int in_json = 0;
  for (std::uint64_t round = 0; round < 500; ++round) {
    Dice dice(round);
    const Request request = random_request(dice);
    const std::string line = command_line(request);
    ASSERT_EQ(parse_command_line(line), request) << "round " << round << ": " << line;
    std::string json;
    try {
      json = request_json(request);
    } catch (const Error&) {
      continue;  // bytes at random are not always UTF-8
    }
    ASSERT_EQ(read_request_text(json, "the test"), request) << "round " << round << ": " << json;
    ++in_json;
  }
  EXPECT_GT(in_json, 50);
}

TEST(CommandLine, HoldsOnlyWhatDiffersFromTheDefaults) {
  Request request;
  request.source.inputs = {"a b.ply"};
  request.output.path = "o.png";
  EXPECT_EQ(command_line(request), "splatray-render 'a b.ply' -o o.png");
  request.look.lights.emplace();
  request.settings.kappa = 0.1F;
  request.look.objects = {read_object_change("a:b:hidden=on,mirror=0.25")};
  EXPECT_EQ(
      command_line(request),
      "splatray-render 'a b.ply' --object=a:b:mirror=0.25,hidden=on --lights=none -o o.png --kappa=0.1");
}

TEST(CommandLine, AcceptsWhatPeoplePaste) {
  const Request request = parse_command_line(
      "  build/bin/splatray-render \"it's \\$5.ply\" \\\n --eye -1,2,3 --light 1,2,3 --sun 0,1,0,1,1,1 "
      "--light=4,5,6\n");
  EXPECT_EQ(request.source.inputs.front(), "it's $5.ply");
  EXPECT_EQ(request.view.eye, glm::dvec3(-1.0, 2.0, 3.0));
  ASSERT_EQ(request.look.lights->size(), 3U);
  EXPECT_EQ((*request.look.lights)[1].light.kind, LIGHT_DIRECTIONAL);
  EXPECT_EQ((*request.look.lights)[2].light.position, glm::dvec3(4.0, 5.0, 6.0));
}

TEST(CommandLine, OfASceneOfAProgramsOwnHasNoFile) {
  Request request;
  request.view.width = 32;
  EXPECT_EQ(parse_command_line(command_line(request)), request);
}

TEST(CommandLine, RefusesWhatIsNoCommand) {
  for (const char* line : {"", "   ", "ls -l", "splatray-render 'a.ply", "splatray-render a.ply \"b",
                           "splatray-render a.ply --eye=1", "splatray-render a.ply --no-such-option",
                           "splatray-render a.ply --help", "splatray-render --from a.png"}) {
    try {
      (void)parse_command_line(line);
      ADD_FAILURE() << "accepted: " << line;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage) << line;
    }
  }
}

TEST(NumberText, FloatsSurviveReadingAsDouble) {
  const auto survives = [](float value) {
    return static_cast<float>(std::strtod(number_text(value).c_str(), nullptr)) == value;
  };
  // Its shortest text, 7.038531e-26, is the midpoint of two floats as a double, and then becomes the other one.
  EXPECT_TRUE(survives(std::bit_cast<float>(0x15ae43fdU)));
  Dice dice(1);
  for (int i = 0; i < 100000; ++i) {
    const auto bits = static_cast<std::uint32_t>(dice.seed());
    if (std::isfinite(std::bit_cast<float>(bits))) {
      ASSERT_TRUE(survives(std::bit_cast<float>(bits))) << bits;
    }
  }
  EXPECT_EQ(number_text(0.1F), "0.1");
  EXPECT_EQ(number_text(glm::dvec3(1.0, -2.5, 1e30)), "1,-2.5,1e+30");
}

}  // namespace
}  // namespace splatray
