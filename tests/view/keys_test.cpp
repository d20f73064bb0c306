#include "app/view/model/keys.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <tuple>

namespace splatray {
namespace {

TEST(KeysTest, NoInputMeansTwoThings) {
  std::set<std::tuple<InputKind, int, int>> seen;
  for (const Binding& binding : bindings())
    for (int code = binding.code; code <= binding.last_code; ++code)
      EXPECT_TRUE(seen.insert({binding.input, code, binding.modifiers}).second) << binding_name(binding);
}

TEST(KeysTest, EveryRowDispatchesToItsAction) {
  for (const Binding& binding : bindings())
    for (int code = binding.code; code <= binding.last_code; ++code) {
      const auto command = command_for(binding.input, code, binding.modifiers | GLFW_MOD_CAPS_LOCK);
      ASSERT_TRUE(command.has_value()) << binding_name(binding);
      EXPECT_EQ(command->action, binding.action) << binding_name(binding);
    }
}

TEST(KeysTest, DigitsAndModifiersAreDistinguished) {
  EXPECT_EQ(command_for(InputKind::key, GLFW_KEY_1, 0)->action, Action::view_front);
  EXPECT_EQ(command_for(InputKind::key, GLFW_KEY_KP_7, GLFW_MOD_CONTROL)->action, Action::view_bottom);
  EXPECT_EQ(command_for(InputKind::key, GLFW_KEY_4, GLFW_MOD_SHIFT)->digit, 4);
  EXPECT_EQ(command_for(InputKind::key, GLFW_KEY_9, GLFW_MOD_ALT)->action, Action::bookmark_go);
  EXPECT_FALSE(
      command_for(InputKind::key, GLFW_KEY_W, 0).has_value());  // flies only while the right button is down
  EXPECT_FALSE(command_for(InputKind::key, GLFW_KEY_F, GLFW_MOD_ALT).has_value());
}

TEST(KeysTest, FlyDirectionIsTheSumOfTheKeysDown) {
  const auto direction = [](const std::set<int>& down) {
    return fly_direction([&](int key) { return down.contains(key); });
  };
  EXPECT_EQ(direction({GLFW_KEY_W, GLFW_KEY_D, GLFW_KEY_E}), glm::dvec3(1.0, 1.0, 1.0));
  EXPECT_EQ(direction({GLFW_KEY_S, GLFW_KEY_A, GLFW_KEY_Q}), glm::dvec3(-1.0, -1.0, -1.0));
  EXPECT_EQ(direction({GLFW_KEY_W, GLFW_KEY_S}), glm::dvec3(0.0));
}

TEST(KeysTest, RowsJoinKeysThatDoTheSame) {
  std::set<std::string> keys;
  for (const KeyRow& row : key_rows()) keys.insert(row.keys);
  for (const char* joined : {"W, A, S, D, Q, E", "Shift+1..9", "S, Ctrl+S", "double click, middle click"})
    EXPECT_TRUE(keys.contains(joined)) << joined;
}

TEST(KeysTest, ReadmeShowsTheTable) {
  std::ifstream file(SPLATRAY_SOURCE_DIR "/app/view/README.md");
  std::ostringstream readme;
  readme << file.rdbuf();
  EXPECT_NE(readme.str().find("## Keys of the viewer\n"), std::string::npos);
  EXPECT_NE(readme.str().find("\n" + keys_markdown() + "\n"), std::string::npos)
      << "app/view/README.md must hold what splatray-view --keys prints:\n"
      << keys_markdown();
}

}  // namespace
}  // namespace splatray
