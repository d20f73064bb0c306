/// What scans are of, and which way they stand.
#include "engine/image/scan_kind.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/image/upright.h"
#include "engine/image/view.h"
#include "engine/image/view_check.h"
#include "tests/host/scenes.h"

namespace splatray {
namespace {

using std::numbers::pi;

constexpr double GOLDEN = 2.399963;  ///< radians between neighbours of a sunflower, which fill discs evenly

/// A hill of 100 m whose points lie evenly, or ever further apart away from its middle.
OrientedPoints ground(bool crowded) {
  OrientedPoints points;
  constexpr int COUNT = 20000;
  for (int i = 0; i < COUNT; ++i) {
    const double share = (i + 0.5) / COUNT, away = 50.0 * (crowded ? share * share : std::sqrt(share));
    points.emplace_back(
        glm::dvec3(away * std::cos(GOLDEN * i), away * std::sin(GOLDEN * i), 4.0 * std::cos(away / 20.0)),
        glm::dvec3(0.0, 0.0, 1.0));
  }
  return points;
}

/// A cone about `up` on a flat base, ten times as many points on its side as below.
OrientedPoints cone(const glm::dvec3& up) {
  const glm::dmat3 axes = upright_axes(up);
  OrientedPoints points;
  for (int i = 0; i < 11000; ++i) {
    const bool below = i % 11 == 0;
    const double away = std::sqrt((i + 0.5) / 11000.0);
    const glm::dvec3 out = std::cos(GOLDEN * i) * axes[0] + std::sin(GOLDEN * i) * axes[2];
    points.emplace_back(away * out + (below ? 0.0 : 2.0 * (1.0 - away)) * axes[1],
                        below ? -axes[1] : glm::normalize(2.0 * out + axes[1]));
  }
  return points;
}

TEST(SceneKind, FollowsThePoints) {
  Scene model = scan_scene(box_points({4.0, 5.0, 3.0}, true));
  model.stations.clear();
  EXPECT_EQ(kind_of_scan(model), SceneKind::none);
  EXPECT_EQ(kind_of_scan(scan_scene(box_points({4.0, 5.0, 3.0}, true))), SceneKind::room);
  EXPECT_EQ(kind_of_scan(scan_scene(box_points({4.0, 5.0, 3.0}, false))), SceneKind::object) << "open above";
  EXPECT_EQ(kind_of_scan(scan_scene(cone({0, 0, 1}))), SceneKind::object);
  EXPECT_EQ(kind_of_scan(scan_scene(ground(false))), SceneKind::site) << "its middle lies below the hilltop";
  EXPECT_EQ(kind_of_scan(scan_scene(ground(true))), SceneKind::sweep);
}

/// A road of 120 m is long, so that half of its points lie near its middle, however even they are.
TEST(SceneKind, AnEvenRoadAboutTheOriginIsNoSweep) {
  OrientedPoints road;
  constexpr int COUNT = 20000;
  for (int i = 0; i < COUNT; ++i) {
    const double along = (i + 0.5) / COUNT - 0.5, across = std::fmod(i * std::numbers::phi, 1.0) - 0.5;
    road.emplace_back(glm::dvec3(120.0 * along, 8.0 * across, 0.0), glm::dvec3(0.0, 0.0, 1.0));
  }
  EXPECT_EQ(kind_of_scan(scan_scene(road)), SceneKind::site);
}

TEST(SceneKind, ABoxThatFacesOutIsNoRoom) {
  OrientedPoints points = box_points({4.0, 5.0, 3.0}, true);
  for (auto& [position, normal] : points) normal = -normal;
  EXPECT_EQ(kind_of_scan(scan_scene(points)), SceneKind::object);
}

/// Half a room: the floor and two walls, which face in, as seen from the default camera's side they turn their backs.
OrientedPoints half_room() {
  OrientedPoints points = box_points({4.0, 5.0, 3.0}, true);
  std::erase_if(points, [](const auto& point) {
    return point.second.x > 0.5 || point.second.y < -0.5 || point.second.z < -0.5;
  });
  return points;
}

TEST(CheckedViews, WallsThatTurnTheirBacksOpen) {
  const Scene half = scan_scene(half_room());
  ASSERT_EQ(kind_of_scan(half), SceneKind::object);
  const std::vector<CheckedView> views = check_views(half, SceneKind::object, choose_viewpoint(half));
  ASSERT_EQ(views.size(), 2U);
  EXPECT_EQ(views[0].viewpoint, Viewpoint::front);
  EXPECT_EQ(views[0].fault, ViewFault::closed);
  EXPECT_GT(views[0].share, 0.5);
  EXPECT_EQ(views[1].viewpoint, Viewpoint::dollhouse);
  EXPECT_EQ(views[1].fault, ViewFault::none);
  OrientedPoints turned = half_room();
  for (auto& [position, normal] : turned) position.x = -position.x, normal.x = -normal.x;
  const Scene other = scan_scene(turned);
  EXPECT_EQ(check_view(other, sample_points(other), Viewpoint::dollhouse).fault, ViewFault::none)
      << "it is looked into from its open side, where nothing faces away";
}

TEST(CheckedViews, ACaveThatWasScannedFromWithinOpens) {
  OrientedPoints cave = cone({0, 0, 1});
  for (auto& [position, normal] : cave) normal = -normal;
  Scene scene = scan_scene(cave);
  scene.stations[0].sensor_world = glm::dvec3(0.0, 0.0, 0.5);
  for (const SceneKind kind : {SceneKind::sweep, SceneKind::object}) {
    const std::vector<CheckedView> views = check_views(scene, kind, Viewpoint::oblique);
    ASSERT_EQ(views.size(), 2U);
    EXPECT_EQ(views[0].fault, ViewFault::closed);
    EXPECT_EQ(views[1].viewpoint, Viewpoint::dollhouse);
    EXPECT_EQ(views[1].fault, ViewFault::none);
  }
  scene.stations[0].sensor_world.reset();
  EXPECT_EQ(check_views(scene, SceneKind::sweep, Viewpoint::oblique).size(), 1U) << "the sides are a guess";
  scene.stations[0].sensor_found_world = glm::dvec3(0.0, 0.0, 0.5);
  EXPECT_EQ(check_views(scene, SceneKind::sweep, Viewpoint::oblique).back().viewpoint, Viewpoint::dollhouse);
  Scene open = scan_scene(ground(true));
  open.stations[0].sensor_world = glm::dvec3(0.0, 0.0, 6.0);
  EXPECT_EQ(check_views(open, SceneKind::sweep, Viewpoint::oblique).size(), 1U);
}

TEST(CheckedViews, SweepsAreSeenFromTheirScannersPlace) {
  Scene sweep = scan_scene(ground(true));
  EXPECT_EQ(choose_viewpoint(sweep), Viewpoint::oblique) << "no place is known";
  const glm::dvec3 place(0.0, 0.0, 6.0);
  sweep.stations[0].sensor_found_world = place;
  EXPECT_EQ(choose_viewpoint(sweep), Viewpoint::inside);
  EXPECT_EQ(viewpoint_camera(sweep, Viewpoint::inside, 1.5, {}).eye, place);
  const std::vector<CheckedView> views = check_views(sweep, SceneKind::sweep, Viewpoint::inside);
  EXPECT_NE(views[0].fault, ViewFault::none) << "a bare hill";
  EXPECT_EQ(views.back().viewpoint, Viewpoint::oblique);
  OrientedPoints yard = ground(true);
  for (int i = 0; i < 4000; ++i)  // a house at the side where the fewest points are
    yard.emplace_back(glm::dvec3(-8.0, 0.002 * i - 4.0, 10.0 * std::fmod(i * std::numbers::phi, 1.0)),
                      glm::dvec3(1.0, 0.0, 0.0));
  for (int i = 0; i < 12000; ++i)
    yard.emplace_back(glm::dvec3(30.0 + 1e-3 * i, std::fmod(0.37 * i, 9.0), 0.0), glm::dvec3(0, 0, 1));
  Scene lived = scan_scene(yard);
  lived.stations[0].sensor_world = place;
  const Camera camera = viewpoint_camera(lived, Viewpoint::inside, 1.5, {});
  EXPECT_LT(glm::normalize(camera.target - camera.eye).x, -0.7)
      << "to the house, not to where most points are";
}

TEST(DollHouse, IsLookedIntoFromWhereItsWallsFace) {
  const auto eye = [](const OrientedPoints& points) {
    return viewpoint_camera(scan_scene(points), Viewpoint::dollhouse, 1.5, {}).eye;
  };
  const glm::dvec3 usual = eye(box_points({4.0, 5.0, 3.0}, true));
  EXPECT_LT(usual.x, 0.0);
  EXPECT_LT(usual.y, 0.0);
  OrientedPoints turned = half_room();
  for (auto& [position, normal] : turned) position.x = -position.x, normal.x = -normal.x;
  const glm::dvec3 other = eye(turned);
  EXPECT_GT(other.x, 0.0) << "the walls at the left and the front face right and back";
  EXPECT_GT(other.y, 0.0);
}

TEST(CheckedViews, WhatShowsItsFrontStays) {
  OrientedPoints box = box_points({4.0, 5.0, 3.0}, true);
  for (auto& [position, normal] : box) normal = -normal;
  EXPECT_EQ(check_views(scan_scene(box), SceneKind::object, Viewpoint::front).size(), 1U);
  OrientedPoints turned = cone({0, 0, 1});
  for (auto& [position, normal] : turned) normal = -normal;
  EXPECT_EQ(check_views(scan_scene(turned), SceneKind::object, Viewpoint::front).size(), 1U)
      << "round things are no walls";
  EXPECT_EQ(check_views(scan_scene(ground(false)), SceneKind::site, Viewpoint::oblique).back().viewpoint,
            Viewpoint::oblique);
}

TEST(CheckedViews, ADollsHouseThatStaysClosedIsFound) {
  OrientedPoints box = box_points({4.0, 5.0, 3.0}, true);
  const Scene room = scan_scene(box);
  const CheckedView open = check_view(room, sample_points(room), Viewpoint::dollhouse);
  EXPECT_EQ(open.fault, ViewFault::none);
  EXPECT_GT(open.share, 0.9);
  for (auto& [position, normal] : box) normal = -normal;
  const Scene turned = scan_scene(box);
  const CheckedView closed = check_view(turned, sample_points(turned), Viewpoint::dollhouse);
  EXPECT_EQ(closed.fault, ViewFault::closed);
  EXPECT_LT(closed.share, 0.1);
}

TEST(CheckedViews, FiguresAreThoseOfTheForemostPoints) {
  const Scene room = scan_scene(box_points({4.0, 5.0, 3.0}, true));
  const PointSample sample = sample_points(room);
  const Camera within{.eye = {0, 0, 0}, .target = {0, 1, 0}, .up = {0, 0, 1}, .fov_y_deg = 50.0};
  const ViewFigures figures = view_figures(sample, within, false);
  EXPECT_LT(figures.background, 0.1);
  EXPECT_LT(figures.behind, 0.01);
  EXPECT_GT(figures.plane, 0.7) << "the wall before it fills the picture";
  EXPECT_EQ(figures.near, 0.0);
  const Camera before{.eye = {0, -30, 0}, .target = {0, 0, 0}, .up = {0, 0, 1}, .fov_y_deg = 5.0};
  EXPECT_GT(view_figures(sample, before, false).behind, 0.9) << "the room's outside";
  EXPECT_LT(view_figures(sample, before, true).behind, 0.01) << "is left out";
  const Camera at_wall{.eye = {0, 2.45, 0}, .target = {0, 0, 0}, .up = {0, 0, 1}, .fov_y_deg = 50.0};
  EXPECT_EQ(view_figures(
                sample, {.eye = {0, 2.4, 0}, .target = {0, 9, 0}, .up = {0, 0, 1}, .fov_y_deg = 120.0}, false)
                .near,
            1.0);
  EXPECT_EQ(view_figures(sample, at_wall, false).near, 0.0);
}

TEST(SceneKind, WhatIsSeenFromOnePlaceIsASensorsView) {
  const glm::dvec3 eye(0.0, -4.0, 1.0);
  OrientedPoints points = cone({0, 0, 1});
  std::erase_if(points, [&](const auto& point) { return glm::dot(point.second, eye - point.first) < 0.0; });
  Scene scene = scan_scene(points);
  scene.stations[0].sensor_world = eye;
  EXPECT_EQ(kind_of_scan(scene), SceneKind::camera);
  scene.stations.resize(2);
  EXPECT_EQ(kind_of_scan(scene), SceneKind::object) << "two stations see all sides";
  scene.stations.resize(1);
  scene.stations[0].sensor_world = glm::dvec3(0.0, -0.5, 1.0);
  EXPECT_EQ(kind_of_scan(scene), SceneKind::object) << "from too near to be seen at one glance";
}

/// A street with a car in it, cut to what lies before the car that scanned it: its trees hide what is behind them, and much is seen past
/// them.
TEST(SceneKind, WhatAKnownScannerSawAheadIsItsView) {
  OrientedPoints street;
  for (int i = 0; i < 9000; ++i) {
    const double along = 5.0 + 0.005 * i, across = std::fmod(i * std::numbers::phi, 1.0) - 0.5;
    street.emplace_back(glm::dvec3(along, along * across, -1.7), glm::dvec3(0, 0, 1));
    if (i % 3 == 0) street.emplace_back(glm::dvec3(along, 3.0, 2.0 * across), glm::dvec3(0, -1, 0));
    if (i % 3 == 1) street.emplace_back(glm::dvec3(along, 6.0, 3.0 * across), glm::dvec3(0, -1, 0));
  }
  Scene scene = scan_scene(street);
  EXPECT_NE(kind_of_scan(scene), SceneKind::camera) << "that it was seen from the origin is a guess";
  scene.stations[0].sensor_world = glm::dvec3(0.0);
  EXPECT_EQ(kind_of_scan(scene), SceneKind::camera);
  EXPECT_EQ(choose_viewpoint(scene), Viewpoint::sensor);
}

TEST(SceneKind, ACamerasFrameIsKnownByItsOrigin) {
  OrientedPoints wall;
  for (int x = 0; x < 60; ++x)
    for (int y = 0; y < 60; ++y)
      wall.emplace_back(glm::dvec3(0.02 * (x - 30), 0.02 * (y - 30), 2.0 + 0.005 * x),
                        glm::dvec3(0, 0, x % 2 == 0 ? 1 : -1));
  Scene scene = scan_scene(wall);
  scene.up = {0.0, 1.0, 0.0};
  EXPECT_EQ(kind_of_scan(scene), SceneKind::camera);
  EXPECT_EQ(upright(scene).up, glm::dvec3(0, -1, 0));
  EXPECT_EQ(seeing_place(scene, sample_points(scene)), glm::dvec3(0.0));
  OrientedPoints behind = wall;
  for (const auto& [position, normal] : wall) behind.emplace_back(1.5 * position, normal);
  EXPECT_FALSE(seeing_place(scan_scene(behind), sample_points(scan_scene(behind))))
      << "a wall hides the other";
  for (auto& [position, normal] : wall) position.x += 5.0;
  EXPECT_NE(kind_of_scan(scan_scene(wall)), SceneKind::camera) << "not along z";
  for (auto& [position, normal] : wall) normal.z = -1.0;
  EXPECT_EQ(upright(scan_scene(wall)).up, glm::dvec3(0, -1, 0))
      << "it faces down, as only a camera's frame can";
}

/// Ground in local coordinates, 80 m above their zero: the origin sees all of it from below.
TEST(SceneKind, TerrainAboveItsDatumIsNoCamerasView) {
  OrientedPoints hill = ground(false);
  for (auto& [position, normal] : hill) position.z += 80.0;
  const Scene scene = scan_scene(hill);
  EXPECT_EQ(kind_of_scan(scene), SceneKind::site);
  EXPECT_EQ(upright(scene).up, glm::dvec3(0, 0, 1));
}

TEST(Upright, ThingsStandOnTheirFlatEnd) {
  for (const glm::dvec3 up :
       {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0), glm::dvec3(-1, 0, 0)})
    EXPECT_EQ(upright(scan_scene(cone(up))).up, up);
  Scene model = scan_scene(cone({0, 1, 0}));
  model.stations.clear();
  EXPECT_EQ(upright(model).up, model.up) << "no scan";
}

/// A statue: a tall half ellipsoid with a nose, three times as high as wide, and its pedestal's edges; no scanner saw what it stands on.
OrientedPoints statue(const glm::dvec3& up) {
  const glm::dmat3 axes = upright_axes(up);
  OrientedPoints points;
  for (int i = 0; i < 12000; ++i) {
    const double height = (i + 0.5) / 12000.0, nose = height > 0.6 && height < 0.7 ? 1.4 : 1.0;
    const double away = height < 0.1 ? 0.4 : 0.3 * std::sqrt(1.0 - height * height);
    const glm::dvec3 out = std::cos(GOLDEN * i) * axes[0] + std::sin(GOLDEN * i) * axes[2];
    const double stretch = glm::dot(out, axes[0]) > 0.9 ? nose : 1.0;
    points.emplace_back(stretch * away * out + height * axes[1],
                        glm::normalize(out + 0.3 * height * axes[1]));
  }
  return points;
}

PointSample sample_of(const OrientedPoints& points) { return sample_points(scan_scene(points)); }

TEST(Upright, StatuesStandOnTheirLowerEnd) {
  const glm::dvec3 y(0, 1, 0), z(0, 0, 1);
  for (const glm::dvec3& up : {y, z}) {
    EXPECT_EQ(upright_model(sample_of(statue(up))), up);
    EXPECT_GT(stands_on(sample_of(statue(up)), up), 0.6);
    EXPECT_LT(stands_on(sample_of(statue(up)), up == y ? z : y), 0.1);
    for (const glm::dvec3& format : {y, z}) {
      Scene scene = scan_scene(statue(up));
      scene.up = format;
      EXPECT_EQ(upright(scene).up, up);
    }
  }
}

TEST(Upright, ModelsThatStandOnNeitherEndStayAsTheirFormatHasThem) {
  OrientedPoints ball, relief, leaning = statue({0, 0, 1});
  for (int i = 0; i < 5000; ++i) {
    const double z = 2.0 * (i + 0.5) / 5000.0 - 1.0, level = std::sqrt(1.0 - z * z);
    const glm::dvec3 normal(level * std::cos(GOLDEN * i), level * std::sin(GOLDEN * i), z);
    ball.emplace_back(normal, normal);
    if (z > 0.0) relief.emplace_back(normal, normal);
  }
  for (auto& [position, normal] : leaning) position.x += 1.2 * position.z;
  EXPECT_EQ(upright_model(sample_of(ball)), glm::dvec3(0, 1, 0));
  EXPECT_EQ(upright_model(sample_of(relief)), glm::dvec3(0, 1, 0))
      << "seen from one side, it does not stand on its rim";
  EXPECT_EQ(upright_model(sample_of(leaning)), glm::dvec3(0, 1, 0)) << "it would fall over";
  EXPECT_EQ(upright_model(sample_of(box_points({4.0, 5.0, 1.0}, true))), glm::dvec3(0, 1, 0)) << "a panel";
  EXPECT_EQ(upright_model({}), glm::dvec3(0, 1, 0));
}

TEST(Upright, RoomsAndTerrainStayAsTheirFormatHasThem) {
  EXPECT_EQ(upright(scan_scene(box_points({4.0, 5.0, 3.0}, true))).up, glm::dvec3(0, 0, 1));
  EXPECT_EQ(upright(scan_scene(ground(false))).up, glm::dvec3(0, 0, 1));
  OrientedPoints wall = box_points({4.0, 0.2, 3.0}, false);
  EXPECT_EQ(upright(scan_scene(wall)).up, glm::dvec3(0, 0, 1)) << "a wall is no floor";
}

/// A place's points in a format that says no up direction: the terrain of a survey, around a middle.
PointSample terrain_around(const glm::dvec3& middle, double height) {
  PointSample sample;
  for (int i = 0; i < 5000; ++i)
    sample.position.push_back(middle + glm::dvec3(100.0 * std::fmod(0.618034 * i, 1.0), 80.0 * i / 5000.0,
                                                  height * std::fmod(0.754878 * i, 1.0)));
  sample.normal.resize(sample.size(), glm::dvec3(0.0));
  return sample;
}

TEST(Upright, TerrainAndSurveysHaveZUpWhereNothingIsSaid) {
  const glm::dvec3 y(0, 1, 0), z(0, 0, 1);
  const UpFound low = upright_places(terrain_around({-40.0, -30.0, -2.0}, 10.0), false);
  EXPECT_EQ(low.up, z);
  EXPECT_EQ(low.by, UpEvidence::sheet);
  EXPECT_NEAR(low.figure, 10.0 / 80.0, 0.01);
  EXPECT_EQ(upright_places(terrain_around({-40.0, -30.0, -2.0}, 60.0), false).up, y) << "as high as wide";
  EXPECT_EQ(upright_places(terrain_around({-40.0, -30.0, 90.0}, 10.0), false).up, y)
      << "a range finder may look along z";
  const UpFound far = upright_places(terrain_around({4.5e5, 5.4e6, 300.0}, 60.0), false);
  EXPECT_EQ(far.up, z);
  EXPECT_EQ(far.by, UpEvidence::survey);
  EXPECT_GT(far.figure, 1e4);
  EXPECT_EQ(upright_places(terrain_around({4.5e3, 5.4e3, 300.0}, 60.0), false).up, y)
      << "millimetres of a machine";
  EXPECT_EQ(upright_places({}, false).up, y);
}

/// A hollow of 96 m, 37 m deep, whose points crowd about the scanner at its bottom.
TEST(Upright, ASweepOfWhichNothingIsSaidStandsAcrossItsWidth) {
  OrientedPoints hollow = ground(true);
  for (auto& [position, normal] : hollow) position = {position.x, position.z * -5.0 + 20.0, position.y};
  for (int axis = 0; axis < 3; ++axis) {
    PointSample sample;
    glm::dvec3 up(0.0);
    up[(1 + axis) % 3] = 1.0;
    for (const auto& [p, normal] : hollow)
      sample.position.emplace_back(p[(3 - axis) % 3], p[(4 - axis) % 3], p[(5 - axis) % 3]);
    EXPECT_EQ(upright_places(sample, false).up, up);
  }
}

/// More of its ceiling was seen than of its floor, and little of two walls.
TEST(Upright, ARoomHangsFromNoCeiling) {
  OrientedPoints room;
  int walls = 0;
  for (const auto& point : box_points({4.0, 5.0, 3.0}, true)) {
    if (std::abs(point.second.y) > 0.5 && ++walls % 4 != 0) continue;
    room.insert(room.end(), point.second.z < -0.5 ? 4 : point.second.z > 0.5 ? 2 : 1, point);
  }
  Scene scene = scan_scene(room);
  scene.up = {0.0, 1.0, 0.0};
  ASSERT_EQ(kind_of_scan(scene), SceneKind::room);
  EXPECT_EQ(upright(scene).up, glm::dvec3(0, 0, 1));
}

TEST(Upright, SaysWhatDecided) {
  const UpFound found = upright(scan_scene(cone({0, 1, 0})));
  EXPECT_NE(found.by, UpEvidence::format);
  EXPECT_GT(found.figure, 0.0);
  EXPECT_STREQ(up_evidence_name(UpEvidence::feet), "feet");
  EXPECT_EQ(upright(scan_scene(box_points({4.0, 5.0, 3.0}, true))).by, UpEvidence::format);
}

TEST(Upright, ATurntablesRingShowsItsAxis) {
  OrientedPoints ball;
  for (int i = 0; i < 5000; ++i) {
    const double z = 2.0 * (i + 0.5) / 5000.0 - 1.0, level = std::sqrt(1.0 - z * z);
    const glm::dvec3 normal(level * std::cos(GOLDEN * i), level * std::sin(GOLDEN * i), z);
    ball.emplace_back(normal, normal);
  }
  Scene scene = scan_scene(ball);
  scene.stations.clear();
  for (int i = 0; i < 6; ++i)
    scene.stations.push_back(
        {"", glm::dvec3(3.0 * std::cos(pi * i / 3.0), 0.1, 3.0 * std::sin(pi * i / 3.0)), 0, 0});
  EXPECT_EQ(std::abs(upright(scene).up.y), 1.0);
  EXPECT_EQ(upright(scene).by, UpEvidence::ring);
}

TEST(MainParts, LeaveOutWhatIsSmallAndFarAway) {
  OrientedPoints points = box_points({4.0, 5.0, 3.0}, true);
  const std::size_t count = points.size();
  for (int i = 0; i < 50; ++i)
    points.emplace_back(glm::dvec3(30.0 + 0.01 * i, 0.0, 0.0), glm::dvec3(1, 0, 0));
  EXPECT_EQ(main_parts(sample_points(scan_scene(points))).size(), count);
  for (int i = 0; i < 2000; ++i)
    points.emplace_back(glm::dvec3(30.0 + 0.001 * i, 1.0, 0.0), glm::dvec3(1, 0, 0));
  EXPECT_GT(main_parts(sample_points(scan_scene(points))).size(), count + 1900)
      << "a second thing is no stray";
}

}  // namespace
}  // namespace splatray
