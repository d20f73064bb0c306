#include <gtest/gtest.h>

#include "app/view/ui/panels.h"
#include "tests/view/documents.h"

namespace splatray {
namespace {

class CommandsTest : public ::testing::Test {
 protected:
  bool act(Action action, int digit = 0) { return apply({action, digit}, 1.5, document, state); }

  Document document = box_document({1.0, 2.0, 3.0}, 2.0);
  PanelState state;
};

TEST_F(CommandsTest, EscapeClosesOneThingAtATimeAndNothingElse) {
  state.error = "a sentence";
  state.show_save = state.show_help = true;
  EXPECT_TRUE(act(Action::escape));
  EXPECT_TRUE(state.error.empty() && state.show_save);
  EXPECT_TRUE(act(Action::escape));
  EXPECT_TRUE(!state.show_save && state.show_help);
  EXPECT_TRUE(act(Action::escape));
  EXPECT_FALSE(state.show_help);
  EXPECT_FALSE(act(Action::escape));  // the caller's: cancel what is under way
}

TEST_F(CommandsTest, WhatNeedsTheWindowIsLeftToTheCaller) {
  for (const Action action :
       {Action::quit, Action::copy_command, Action::paste_command, Action::pivot, Action::inspect})
    EXPECT_FALSE(act(action));
}

TEST_F(CommandsTest, KeysDoNothingBehindADialog) {
  state.show_save = true;
  const Camera before = document.camera;
  EXPECT_TRUE(act(Action::view_top));
  EXPECT_TRUE(act(Action::paste_command));
  EXPECT_EQ(document.camera, before);
  EXPECT_FALSE(act(Action::quit));
}

TEST_F(CommandsTest, HomeAndBookmarksBringCamerasBack) {
  state.home = document.camera;
  EXPECT_TRUE(act(Action::view_top));
  EXPECT_TRUE(act(Action::bookmark_set, 9));
  const Camera top = document.camera;
  EXPECT_TRUE(act(Action::home));
  EXPECT_EQ(document.camera, state.home);
  EXPECT_TRUE(act(Action::bookmark_go, 9));
  EXPECT_EQ(document.camera, top);
  EXPECT_TRUE(act(Action::bookmark_go, 1));
  EXPECT_EQ(document.camera, top);
  EXPECT_NE(state.notice.find("not set"), std::string::npos);
}

TEST_F(CommandsTest, ModesAndUpAxesGoRound) {
  for (int i = 0; i < VIEW_MODE_COUNT; ++i) {
    EXPECT_EQ(static_cast<int>(document.mode), i);
    EXPECT_TRUE(act(Action::mode_next));
  }
  EXPECT_EQ(document.mode, ViewMode::shaded);
  EXPECT_TRUE(act(Action::mode_previous));
  EXPECT_EQ(static_cast<int>(document.mode), VIEW_MODE_COUNT - 1);
  for (const glm::dvec3& up : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}) {
    EXPECT_TRUE(act(Action::up_axis));
    EXPECT_EQ(up_of(document), up);
  }
}

TEST_F(CommandsTest, SwitchesSwitch) {
  EXPECT_TRUE(act(Action::orthographic));
  EXPECT_GT(document.camera.ortho_height, 0.0);
  EXPECT_TRUE(act(Action::panels));
  EXPECT_FALSE(state.show_panels);
  EXPECT_TRUE(act(Action::help));
  EXPECT_TRUE(state.show_help);
  EXPECT_TRUE(act(Action::save));
  EXPECT_TRUE(state.show_save);
}

}  // namespace
}  // namespace splatray
