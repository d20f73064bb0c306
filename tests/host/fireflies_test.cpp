#include "engine/image/fireflies.h"

#include <gtest/gtest.h>

namespace splatray {
namespace {

/// Grey, of 8 samples a pixel; the part has the first two of them.
Image grey() {
  Image image{7, 5, std::vector<vec4>(35, vec4(0.5F, 0.5F, 0.5F, 1.0F)), {}};
  image.part = image.rgba;
  image.part_share = 0.25F;
  return image;
}

TEST(Fireflies, WhatTheOthersAloneFindIsLimited) {
  Image image = grey();
  image.rgba[17] = vec4(100.0F, 100.0F, 100.0F, 0.5F);
  const Image clean = without_fireflies(image);
  EXPECT_NEAR(clean.rgba[17].x, 0.25F * 0.5F + 0.75F * 1.5F * 0.5F, 1e-4F);
  EXPECT_EQ(clean.rgba[17].w, 0.5F);
}

TEST(Fireflies, WhatThePartAloneFindsIsLimitedWithItsColour) {
  for (const std::size_t pixel : {0U, 6U, 17U, 34U}) {
    Image image = grey();
    image.part[pixel] = vec4(400.0F, 0.0F, 0.0F, 1.0F);
    image.rgba[pixel] = 0.25F * image.part[pixel] + 0.75F * vec4(0.5F, 0.5F, 0.5F, 1.0F);
    const vec4 clean = without_fireflies(image).rgba[pixel];
    EXPECT_LT(clean.x, 2.0F);
    EXPECT_GT(clean.x, clean.y);
  }
}

TEST(Fireflies, WhatBothFindStays) {
  Image image = grey();
  image.rgba[17] = image.part[17] = vec4(100.0F);
  image.rgba[3] = vec4(0.6F, 0.5F, 0.5F, 1.0F);
  EXPECT_TRUE(without_fireflies(image).rgba == image.rgba);
}

/// A bright edge that the halves see one pixel apart.
TEST(Fireflies, WhatTheOtherFindsBesideItStays) {
  Image image = grey();
  image.rgba[17] = vec4(50.0F);
  image.part[16] = vec4(60.0F);
  image.rgba[16] = vec4(15.375F);
  EXPECT_EQ(without_fireflies(image).rgba[17].x, 50.0F);
}

}  // namespace
}  // namespace splatray
