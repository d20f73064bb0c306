// What is shown of a scan before its scene is made: the sample, how it is drawn, and its shading.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "app/library/shot/scene_source.h"
#include "app/view/display/eye_dome.h"
#include "app/view/model/document_request.h"
#include "app/view/thread/point_picture.h"
#include "app/view/thread/point_sampler.h"
#include "tests/view/documents.h"

namespace splatray {
namespace {

constexpr float NOTHING = std::numeric_limits<float>::infinity();
const View VIEW{box_document({0.0, 0.0, 0.0}, 2.0).camera, 64, 48};

TEST(EyeDome, ShadesWhatLiesBehindItsNeighbours) {
  std::vector<float> depth(std::size_t{VIEW.width} * VIEW.height, 4.0F);
  for (const float factor : eye_dome(depth, VIEW, 1.0)) EXPECT_EQ(factor, 1.0F) << "level ground";
  for (std::size_t y = 0; y < VIEW.height; ++y)
    for (std::size_t x = 0; x < VIEW.width; ++x)
      if (x >= 32) depth[y * VIEW.width + x] = x < 48 ? 5.0F : NOTHING;
  const std::vector<float> factor = eye_dome(depth, VIEW, 1.0);
  const std::size_t row = 20 * VIEW.width;
  EXPECT_EQ(factor[row + 31], 1.0F) << "before";
  EXPECT_LT(factor[row + 32], 0.5F) << "behind";
  EXPECT_EQ(factor[row + 33], 1.0F);
  EXPECT_EQ(factor[row + 47], 1.0F) << "beside nothing";
  EXPECT_EQ(factor[row + 48], 1.0F) << "nothing";
  for (const float none : eye_dome(depth, VIEW, 0.0)) EXPECT_EQ(none, 1.0F);
}

TEST(EyeDome, IsAsStrongAtAllSizes) {
  const auto slope = [](std::uint32_t scale) {
    const View view{VIEW.camera, VIEW.width * scale, VIEW.height * scale};
    std::vector<float> depth;
    for (std::uint32_t y = 0; y < view.height; ++y)
      for (std::uint32_t x = 0; x < view.width; ++x)
        depth.push_back(4.0F * std::exp2(0.01F * float(x) / float(scale)));
    return eye_dome(depth, view, 1.0)[std::size_t{view.width} * (view.height / 2) + view.width / 2];
  };
  EXPECT_LT(slope(1), 0.99F);
  EXPECT_NEAR(slope(1), slope(4), 0.01F);
}

PointCloud cloud_of(const std::vector<glm::vec3>& position) {
  PointCloud cloud;
  cloud.position = position;
  for (std::uint32_t i = 0; i < position.size(); ++i) cloud.color.push_back(0xFF000000U | (i + 1));
  return cloud;
}

/// By its red, which PointStyle's default eye_dome would change.
std::size_t seen_at(const PointPicture& picture, const View& view, const glm::dvec2& px) {
  return picture.rgba[4 * (static_cast<std::size_t>(px.y) * view.width + static_cast<std::size_t>(px.x))];
}

const PointStyle FLAT{.eye_dome = 0.0, .background = {0, 0, 0}};

TEST(PointPicture, PutsPointsWhereTheCameraSeesThem) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> edge(-0.9F, 0.9F);
  for (const double ortho : {0.0, 3.0}) {
    View view{VIEW.camera, 320, 240};
    view.camera.ortho_height = ortho;
    for (int i = 0; i < 40; ++i) {
      const glm::vec3 point(edge(random), edge(random), edge(random));
      PointCloud cloud = cloud_of({point});
      cloud.origin_world = {4e5, 5e6, 100.0};
      View far = view;
      far.camera.eye += cloud.origin_world;
      far.camera.target += cloud.origin_world;
      const PointPicture picture = draw_points(cloud, far, FLAT);
      const glm::dvec2 px = projected(view.camera, point, {view.width, view.height});
      if (glm::length(px - glm::round(px)) < 0.02) continue;  // on the edge of two pixels
      ASSERT_EQ(seen_at(picture, view, px), 1U) << px.x << " " << px.y;
      std::size_t seen = 0;
      for (const float depth : picture.depth_world) seen += depth < NOTHING ? 1 : 0;
      ASSERT_EQ(seen, 1U);
    }
  }
}

TEST(PointPicture, TheNearestPointWinsAndThoseBehindTheEyeAreNotSeen) {
  const glm::dvec3 eye = VIEW.camera.eye;
  const glm::vec3 near(0.5 * eye), far(0.0F), behind(2.0 * eye);
  const glm::dvec2 middle(VIEW.width / 2, VIEW.height / 2);
  const PointPicture picture = draw_points(cloud_of({far, near, behind}), VIEW, FLAT);
  EXPECT_EQ(seen_at(picture, VIEW, middle), 2U);
  EXPECT_NEAR(picture.depth_world[24 * 64 + 32], 0.5 * glm::length(eye), 1e-5);
}

TEST(PointPicture, SquaresFillTheGapsBetweenPoints) {
  PointCloud cloud = cloud_of({});
  for (int y = -20; y <= 20; ++y)
    for (int x = -20; x <= 20; ++x) cloud.position.emplace_back(0.05F * float(x), 0.05F * float(y), 0.0F);
  cloud.color.assign(cloud.position.size(), 0xFF0000FFU);
  cloud.spacing_world = 0.05;
  View view = VIEW;
  view.camera.eye = {0.0, 0.0, 4.0};
  view.width = 320;
  view.height = 240;
  const PointPicture picture = draw_points(cloud, view, FLAT);
  for (std::size_t y = 80; y < 160; ++y)
    for (std::size_t x = 120; x < 200; ++x)
      ASSERT_LT(picture.depth_world[y * 320 + x], NOTHING) << x << " " << y;
}

TEST(PointPicture, CutawayLeavesOutWhatFacesAway) {
  PointCloud cloud = cloud_of({glm::vec3(0.5 * VIEW.camera.eye), glm::vec3(0.0F)});
  const glm::vec3 to_eye(glm::normalize(VIEW.camera.eye));
  cloud.normal = {-to_eye, to_eye};
  const glm::dvec2 middle(VIEW.width / 2, VIEW.height / 2);
  PointStyle style = FLAT;
  EXPECT_EQ(seen_at(draw_points(cloud, VIEW, style), VIEW, middle), 1U);
  style.cutaway = true;
  EXPECT_EQ(seen_at(draw_points(cloud, VIEW, style), VIEW, middle), 2U);
}

/// A box scanned from within: floor, walls and ceiling, each of `side` x `side` points.
Points box_of_points(int side) {
  Points points;
  for (int face = 0; face < 6; ++face)
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        glm::dvec3 p(0.0);
        p[face / 2] = face % 2 == 0 ? 0.0 : (face / 2 == 2 ? 3.0 : 6.0);
        p[(face / 2 + 1) % 3] = (i + 0.5) / side * (face / 2 == 1 ? 3.0 : 6.0);
        p[(face / 2 + 2) % 3] = (j + 0.5) / side * (face / 2 == 0 ? 3.0 : 6.0);
        points.position.push_back(p + glm::dvec3(4e5, 5e6, 100.0));
      }
  return points;
}

Request asked() {
  Request request;
  request.source.inputs = {"box.laz"};
  request.view.width = 960;
  request.view.height = 600;
  return request;
}

TEST(PointSampler, KeepsAnEvenSampleThatIsBounded) {
  PointSampler sampler(asked());
  Points points;
  points.position.resize(PointSampler::MOST / 2 + 1000);
  for (std::size_t file = 0; file < 5; ++file) {
    for (std::size_t i = 0; i < points.size(); ++i) points.position[i] = {double(file), double(i), 0.0};
    points.position[7].x = NAN;
    for (std::size_t first : {std::size_t{0}, points.size() / 3}) {
      Points so_far = points;
      so_far.position.resize(first == 0 ? points.size() / 3 : points.size());
      sampler.add({so_far, first, true});
    }
    EXPECT_LT(sampler.size(), PointSampler::MOST);
  }
  EXPECT_GE(sampler.size(), PointSampler::MOST / 2 - 1);
  const OpenedPoints opened = sampler.make();
  std::array<std::size_t, 5> of_file{};
  for (const glm::vec3& position : opened.points->position)
    ++of_file.at(static_cast<std::size_t>(std::lround(position.x + opened.points->origin_world.x)));
  for (const std::size_t count : of_file) EXPECT_NEAR(double(count), double(sampler.size()) / 5.0, 3.0);
}

TEST(PointSampler, ShowsARoomAsItsSceneIsShown) {
  Points points = box_of_points(60);
  PointSampler sampler(asked());
  sampler.add({points, 0, true});
  const OpenedPoints opened = sampler.make();
  Input input;
  input.objects.emplace_back();
  input.objects[0].points = points;
  input.objects[0].points.stations.resize(1);
  input.objects[0].material = default_material();
  input.up = glm::dvec3(0.0, 0.0, 1.0);
  const LoadedScene loaded = load_objects(std::move(input), asked(), {});
  const Document document = first_document(loaded.scene, loaded.facts, asked());
  EXPECT_EQ(up_of(opened.document), up_of(document));
  EXPECT_EQ(opened.document.request.view.look_in, document.request.view.look_in);
  EXPECT_LT(glm::length(opened.document.camera.eye - document.camera.eye), 0.1);
  EXPECT_LT(glm::length(opened.document.camera.target - document.camera.target), 0.1);
  EXPECT_NEAR(opened.points->spacing_world, 0.1, 0.04);
  EXPECT_TRUE(opened.document.materials.empty());
  EXPECT_EQ(opened.document.request.view.look_in, !opened.points->normal.empty());
}

TEST(PointSampler, ColoursAreThePointsOwnElseTheirHeights) {
  const auto colors = [](Points points) {
    PointSampler sampler(asked());
    sampler.add({points, 0, true});
    return sampler.make().points->color;
  };
  Points points = box_of_points(40);
  const std::vector<std::uint32_t> heights = colors(points);
  EXPECT_NE(heights[heights.size() - 1], heights[heights.size() - 2000]) << "floor and ceiling";
  std::mt19937 random(1);
  for (std::size_t i = 0; i < points.size(); ++i)
    points.stored_color.emplace_back(random() & 255U, random() & 255U, random() & 255U);
  const auto word = [](glm::u16vec3 c) {
    return 0xFF000000U | unsigned{c.z} << 16U | unsigned{c.y} << 8U | c.x;
  };
  EXPECT_EQ(colors(points)[5], word(points.stored_color[5])) << "8 bits";
  const glm::u16vec3 five = points.stored_color[5];
  for (glm::u16vec3& color : points.stored_color) color *= std::uint16_t{257};
  EXPECT_EQ(colors(points)[5], word(five)) << "16 bits";
  points.stored_color.clear();
  points.color.assign(points.size(), glm::vec3(0.0F));
  for (std::size_t i = 0; i < points.size(); i += 2) points.color[i] = {1.0F, 0.2140411F, 0.0F};
  EXPECT_EQ(colors(points)[4], word({255, 127, 0})) << "linear ones";
}

}  // namespace
}  // namespace splatray
