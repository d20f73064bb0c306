// Settings::cutaway: what faces away from the eye is not there, for no ray.
#include "engine/gpu/features.h"
#include "engine/scene/splat.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

/// Two discs that face each other, at z = 0.2 and -0.2: the walls of a room.
Scene two_walls() {
  Scene scene = disc_scene(2);
  for (const double z : {0.2, -0.2}) {
    Splat splat = unpack_splat(scene.data_pool[0]);
    splat.center = glm::round(scene.root.to_root({0.0, 0.0, z}));
    splat.normal = {0.0, 0.0, z > 0.0 ? -1.0 : 1.0};
    splat.object = z > 0.0 ? 0 : 1;
    scene.data_pool.edit()[splat.object] = pack_splat(splat);
  }
  for (Material& material : scene.materials) material.flags = MATERIAL_TWO_SIDED;
  return scene;
}

class CutawayTest : public DeviceTest {
 protected:
  void SetUp() override { tracer.upload(two_walls()); }

  /// The object in the picture's middle and how bright it is, lit by shadow rays from beyond the eye.
  struct Middle {
    std::uint32_t object;
    float bright;
  };
  Middle middle(const View& view, std::uint32_t look, bool cutaway) {
    Settings settings = plain_settings();
    settings.look = look;
    settings.shadows = settings.aov = true;
    settings.cutaway = cutaway;
    const Image image = tracer.render(view, settings);
    const std::size_t at = image.rgba.size() / 2;
    return {image.aov[at].object, image.rgba[at].x};
  }

  ShownTracer tracer{device};
};

TEST_F(CutawayTest, OpensARoomToTheEyeAndTheLight) {
  View parallel = disc_view(9, 9), perspective = parallel;
  perspective.camera.ortho_height = 0.0;
  for (const View& view : {parallel, perspective})
    for (const std::uint32_t look : {LOOK_PAPER, LOOK_LIT}) {
      const Middle closed = middle(view, look, false), open = middle(view, look, true);
      EXPECT_EQ(closed.object, 0U) << "the near wall's back";
      EXPECT_EQ(open.object, 1U) << "the far wall";
      EXPECT_GT(open.bright, 0.1F) << "the near wall shades nothing";
    }
}

TEST_F(CutawayTest, FollowsTheEye) {
  View behind = disc_view(9, 9);
  behind.camera.eye.z = -3.0;
  EXPECT_EQ(middle(behind, LOOK_LIT, false).object, 1U);
  EXPECT_EQ(middle(behind, LOOK_LIT, true).object, 0U);
}

TEST_F(CutawayTest, RaysFromTheEyeHitWhatIsSeen) {
  RayQuery ray{};
  const Scene scene = two_walls();
  ray.origin = scene.root.to_root({0.0, 0.0, 0.9});
  ray.dir = {0.0F, 0.0F, -1.0F};
  ray.from_object = NO_OBJECT;
  Settings settings = plain_settings();
  EXPECT_EQ(tracer.intersect({&ray, 1}, settings).front().object, 0U);
  settings.cutaway = true;
  EXPECT_EQ(tracer.intersect({&ray, 1}, settings).front().object, 1U);
}

TEST(Cutaway, CostsOthersNothing) {
  SceneContent content{};
  content.materials.faces = FACES_BOTH;
  Settings settings;
  EXPECT_EQ(picture_features(content, settings)[SPEC_FACES], FACES_BOTH);
  settings.cutaway = true;
  EXPECT_EQ(picture_features(content, settings)[SPEC_FACES], FACES_CUT);
  content.materials.faces = FACES_FRONT;
  EXPECT_EQ(picture_features(content, settings)[SPEC_FACES], FACES_FRONT)
      << "backs are not seen there anyway";
}

}  // namespace
}  // namespace splatray
