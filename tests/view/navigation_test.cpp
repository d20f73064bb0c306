#include "app/view/model/navigation.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/view/documents.h"

namespace splatray {
namespace {

using std::numbers::pi;

const glm::dvec2 WINDOW_SIZE(800.0, 600.0);

/// Every document, perspective and orthographic.
class EveryDocument : public ::testing::TestWithParam<std::tuple<int, bool>> {
 protected:
  EveryDocument() {
    const auto [index, ortho] = GetParam();
    const NamedDocument named = navigated_documents()[static_cast<std::size_t>(index)];
    document = named.document;
    if (ortho) toggle_orthographic(document);
    radius = scene_radius_world(document);
    is_point = named.name == "one point";
  }

  [[nodiscard]] bool ortho() const { return document.camera.ortho_height > 0.0; }
  [[nodiscard]] double distance() const { return glm::length(document.camera.eye - document.camera.target); }
  [[nodiscard]] glm::dvec3 back() const {
    return (document.camera.eye - document.camera.target) / distance();
  }
  [[nodiscard]] glm::dvec2 pixel_of(const glm::dvec3& point) const {
    return projected(document.camera, point, WINDOW_SIZE);
  }
  /// make_frame_params takes the camera in a scene of the document's size.
  void expect_sees() const {
    Scene scene;
    scene.root.unit_world = 2.0 * radius / (1U << LATTICE_BITS);
    scene.root.origin_world = document.bounds_min_world;
    EXPECT_NO_THROW((void)make_frame_params(scene, {document.camera, 800, 600}, Settings{}));
  }

  Document document;
  double radius = 0.0;
  bool is_point = false;
};

void expect_near(const glm::dvec2& a, const glm::dvec2& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
}

TEST_P(EveryDocument, PointUnderTheCursorProjectsBackToIt) {
  for (const glm::dvec2& at : {glm::dvec2(0.0), glm::dvec2(400.0, 300.0), glm::dvec2(799.0, 17.0)})
    expect_near(pixel_of(point_under(document.camera, at, WINDOW_SIZE)), at, 1e-3);
}

TEST_P(EveryDocument, OrbitKeepsPivotAndDistanceAndNeverFlips) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> drag(-150.0, 150.0);
  const glm::dvec3 pivot = document.camera.target;
  const double before = distance();
  for (int i = 0; i < 1000; ++i) {
    orbit(document, {drag(random), drag(random)}, WINDOW_SIZE);
    const glm::dvec3 right = glm::cross(document.camera.up, back());
    EXPECT_EQ(document.camera.target, pivot);
    EXPECT_NEAR(distance(), before, 1e-4 * before);
    EXPECT_NEAR(right.y, 0.0, 1e-6);         // level
    EXPECT_GE(document.camera.up.y, -1e-9);  // not upside down
  }
  expect_sees();
}

TEST_P(EveryDocument, OrbitStopsAtThePoleAndComesBackOnTheSameMeridian) {
  const glm::dvec3 start = back();
  orbit(document, {0.0, 1e5}, WINDOW_SIZE);
  EXPECT_NEAR(back().y, 1.0, 1e-9);
  expect_sees();
  orbit(document, {37.0, 0.0}, WINDOW_SIZE);
  orbit(document, {-37.0, 0.0}, WINDOW_SIZE);
  orbit(document, {0.0, -(0.5 * pi - std::asin(start.y)) * WINDOW_SIZE.y / pi}, WINDOW_SIZE);
  EXPECT_LT(glm::length(back() - start), 1e-4);
}

TEST_P(EveryDocument, OrbitTurnsTheSceneWithTheDrag) {
  const glm::dvec3 front = document.camera.target + 0.1 * distance() * back();
  const glm::dvec2 before = pixel_of(front);
  orbit(document, {10.0, 5.0}, WINDOW_SIZE);
  EXPECT_GT(pixel_of(front).x, before.x);
  EXPECT_GT(pixel_of(front).y, before.y);
}

TEST_P(EveryDocument, PanKeepsTheGrabbedPointUnderTheCursor) {
  const glm::dvec2 from(200.0, 450.0), to(333.0, 120.0);
  const glm::dvec3 grabbed = point_under(document.camera, from, WINDOW_SIZE), back_before = back();
  pan(document, from, to, WINDOW_SIZE);
  expect_near(pixel_of(grabbed), to, 1e-2);
  EXPECT_LT(glm::length(back() - back_before), 1e-6);
}

TEST_P(EveryDocument, ZoomKeepsThePointUnderTheCursorAndCanBeUndone) {
  const glm::dvec2 at(620.0, 140.0);
  const glm::dvec3 fixed = point_under(document.camera, at, WINDOW_SIZE);
  const auto height = [&] {
    return glm::length(point_under(document.camera, {0, 600}, WINDOW_SIZE) -
                       point_under(document.camera, {0, 0}, WINDOW_SIZE));
  };
  const double before = height();
  for (const double notches : {3.0, -8.0, 5.0}) {
    zoom(document, notches, at, WINDOW_SIZE);
    expect_near(pixel_of(fixed), at, 1e-2);
  }
  EXPECT_NEAR(height(), before, 1e-6 * before);
  zoom(document, 1.0, at, WINDOW_SIZE);
  EXPECT_LT(height(), 0.9 * before);
}

TEST_P(EveryDocument, ZoomEndsBeforeNumbersDo) {
  for (const double notches : {50.0, -50.0}) {
    for (int i = 0; i < 40; ++i) zoom(document, notches, {1.0, 2.0}, WINDOW_SIZE);
    expect_sees();
    orbit(document, {10.0, 10.0}, WINDOW_SIZE);
    expect_sees();
  }
}

TEST_P(EveryDocument, SetPivotCentresThePointAndKeepsItsSize) {
  const glm::dvec3 right = glm::normalize(glm::cross(document.camera.up, back()));
  const double depth = 0.8 * distance();
  const glm::dvec3 point = document.camera.eye - depth * back() + 0.05 * depth * right;
  const glm::dvec3 back_before = back(), beside = point + 0.01 * depth * right;
  const glm::dvec2 apart = pixel_of(beside) - pixel_of(point);
  set_pivot(document, point);
  EXPECT_EQ(document.camera.target, point);
  expect_near(pixel_of(point), 0.5 * WINDOW_SIZE, 1e-3);
  expect_near(pixel_of(beside) - pixel_of(point), apart, 1e-2);
  EXPECT_LT(glm::length(back() - back_before), 1e-6);
  const Camera before = document.camera;
  set_pivot(document, before.eye + distance() * back());  // behind
  EXPECT_EQ(document.camera.eye, before.eye);
}

TEST_P(EveryDocument, FrameAllShowsTheWholeBoxAndNoMoreThanThat) {
  orbit(document, {123.0, 77.0}, WINDOW_SIZE);
  zoom(document, 9.0, {1.0, 2.0}, WINDOW_SIZE);
  const glm::dvec3 before = back();
  frame_all(document, WINDOW_SIZE.x / WINDOW_SIZE.y);
  EXPECT_LT(glm::length(back() - before), 1e-6);
  glm::dvec2 low(1e9), high(-1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::bvec3 upper((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
    const glm::dvec2 at = pixel_of(glm::mix(document.bounds_min_world, document.bounds_max_world, upper));
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  EXPECT_TRUE(glm::all(glm::greaterThan(low, glm::dvec2(0.0))) && glm::all(glm::lessThan(high, WINDOW_SIZE)));
  if (is_point)
    expect_near(low, 0.5 * WINDOW_SIZE, 1.0);
  else
    EXPECT_GT(std::max((high.x - low.x) / WINDOW_SIZE.x, (high.y - low.y) / WINDOW_SIZE.y), 0.9);
}

TEST_P(EveryDocument, OrthographicToggleKeepsTheSizeAtThePivotAndReturns) {
  const auto width = [&] {
    return point_under(document.camera, WINDOW_SIZE, WINDOW_SIZE) - document.camera.target;
  };
  const glm::dvec3 before = width();
  const Camera camera = document.camera;
  const bool was_ortho = ortho();
  toggle_orthographic(document);
  EXPECT_NE(ortho(), was_ortho);
  EXPECT_LT(glm::length(width() - before), 1e-6 * glm::length(before));
  toggle_orthographic(document);
  EXPECT_EQ(ortho(), was_ortho);
  EXPECT_LT(glm::length(document.camera.eye - camera.eye), 1e-6 * distance());
}

TEST_P(EveryDocument, OrthographicCamerasStayOutsideTheScene) {
  if (!ortho()) toggle_orthographic(document);
  zoom(document, 20.0, {100.0, 100.0}, WINDOW_SIZE);
  orbit(document, {400.0, 100.0}, WINDOW_SIZE);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::bvec3 upper((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
    const glm::dvec3 point = glm::mix(document.bounds_min_world, document.bounds_max_world, upper);
    EXPECT_GE(glm::dot(document.camera.eye - point, back()), 0.0);
  }
}

TEST_P(EveryDocument, NothingMakesACameraThatSeesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Camera good = document.camera;
  Camera at_pivot = good, no_up = good, lost = good;
  at_pivot.eye = at_pivot.target;
  no_up.up = glm::dvec3(0.0);
  lost.eye.x = nan;
  for (const Camera& start : {good, at_pivot, no_up, lost})
    for (const double value : {nan, inf, -inf, 0.0, 1e300, 17.0}) {
      SCOPED_TRACE(value);
      document.camera = start;
      const glm::dvec2 place(value, 3.0);
      orbit(document, place, WINDOW_SIZE);
      pan(document, place, {4.0, 5.0}, WINDOW_SIZE);
      zoom(document, value, {4.0, 5.0}, WINDOW_SIZE);
      zoom(document, 1.0, place, WINDOW_SIZE);
      look(document, place, WINDOW_SIZE);
      fly(document, {value, 0.0, 1.0}, value, true);
      set_pivot(document, glm::dvec3(value));
      set_up_axis(document, {0.0, value, 0.0});
      SceneLight light;
      drag_light(document, place, WINDOW_SIZE, light);
      EXPECT_NEAR(glm::length(light.position), 1.0, 1e-6);
      set_axis_view(document, AxisView::top);  // a good camera again, whatever it was
      frame_all(document, 1.5);
      expect_sees();
    }
}

INSTANTIATE_TEST_SUITE_P(Navigation, EveryDocument,
                         ::testing::Combine(testing::Range(0, 5), ::testing::Bool()));

TEST(NavigationTest, LookTurnsAboutTheEye) {
  Document document = box_document({1.0, 2.0, 3.0}, 2.0);
  const Camera before = document.camera;
  const glm::dvec3 point = before.target;
  look(document, {30.0, 20.0}, WINDOW_SIZE);
  EXPECT_LT(glm::length(document.camera.eye - before.eye), 1e-12);
  EXPECT_LT(projected(document.camera, point, WINDOW_SIZE).x, 400.0);  // looked to the right ...
  EXPECT_LT(projected(document.camera, point, WINDOW_SIZE).y, 300.0);  // ... and down
}

TEST(NavigationTest, FlyMovesByTheSizeOfTheScene) {
  Document document = box_document({1.0, 2.0, 3.0}, 2.0);
  const Camera before = document.camera;
  const glm::dvec3 forward = glm::normalize(before.target - before.eye);
  const double step = 0.5 * scene_radius_world(document) * 0.1;
  fly(document, {0.0, 0.0, 1.0}, 0.1, false);
  EXPECT_LT(glm::length(document.camera.eye - (before.eye + step * forward)), 1e-12);
  EXPECT_LT(glm::length((document.camera.target - document.camera.eye) - (before.target - before.eye)),
            1e-12);
  fly(document, {0.0, 0.0, -1.0}, 0.02, true);
  EXPECT_LT(glm::length(document.camera.eye - before.eye), 1e-12);
  fly(document, {1.0, 0.0, 0.0}, 0.1, false);
  EXPECT_NEAR(glm::dot(document.camera.eye - before.eye, forward), 0.0, 1e-12);
  EXPECT_LT(projected(document.camera, before.target, WINDOW_SIZE).x, 400.0);
  fly(document, {0.0, 0.0, 1.0}, 3600.0, false);  // a stall
  EXPECT_LT(glm::length(document.camera.eye - before.eye), 0.5 * scene_radius_world(document));
}

TEST(NavigationTest, AxisViewsFollowTheUpAxis) {
  struct Case {
    AxisView view;
    glm::dvec3 back_y_up, back_z_up;
  };
  for (const Case& c :
       {Case{AxisView::front, {0, 0, 1}, {0, -1, 0}}, Case{AxisView::back, {0, 0, -1}, {0, 1, 0}},
        Case{AxisView::right, {1, 0, 0}, {1, 0, 0}}, Case{AxisView::left, {-1, 0, 0}, {-1, 0, 0}},
        Case{AxisView::top, {0, 1, 0}, {0, 0, 1}}, Case{AxisView::bottom, {0, -1, 0}, {0, 0, -1}}}) {
    Document document = box_document({1.0, 2.0, 3.0}, 2.0);
    const glm::dvec3 pivot = document.camera.target;
    set_axis_view(document, c.view);
    const auto back = [&] { return glm::normalize(document.camera.eye - pivot); };
    EXPECT_LT(glm::length(back() - c.back_y_up), 1e-12);
    set_up_axis(document, {0.0, 0.0, 2.0});
    EXPECT_LT(glm::length(back() - c.back_y_up), 1e-12);  // the camera stays
    EXPECT_EQ(up_of(document), glm::dvec3(0.0, 0.0, 1.0));
    set_axis_view(document, c.view);
    EXPECT_LT(glm::length(back() - c.back_z_up), 1e-12);
  }
}

TEST(NavigationTest, DraggedLightsComeFromWhereTheCursorIs) {
  Document document = box_document({1.0, 2.0, 3.0}, 2.0);
  const glm::dvec3 center(1.0, 2.0, 3.0), back = glm::normalize(document.camera.eye - document.camera.target);
  SceneLight sun, lamp{LIGHT_POINT, center + glm::dvec3(0.0, 9.0, 0.0), glm::vec3(1.0F)};
  for (const bool ortho : {false, true}) {
    drag_light(document, 0.5 * WINDOW_SIZE, WINDOW_SIZE, sun);
    drag_light(document, 0.5 * WINDOW_SIZE, WINDOW_SIZE, lamp);
    EXPECT_LT(glm::length(sun.position - back), 1e-6);
    EXPECT_LT(glm::length(lamp.position - (center + 9.0 * back)), 1e-6);
    drag_light(document, {799.0, 300.0}, WINDOW_SIZE, sun);
    EXPECT_NEAR(glm::length(sun.position), 1.0, 1e-12);
    EXPECT_GT(glm::dot(sun.position, glm::cross(document.camera.up, back)), 0.7);
    if (!ortho) toggle_orthographic(document);
  }
}

}  // namespace
}  // namespace splatray
