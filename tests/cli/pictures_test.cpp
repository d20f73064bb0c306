/// Picture files and their comparison, without a program.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "app/library/image_file.h"
#include "app/library/picture/compare.h"
#include "engine/base/error.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

/// A file in a folder of this program's own.
std::string temporary(const char* name) {
  static const TempFolder folder;
  return folder.path() / name;
}

Image gradient() {
  Image image{4, 3, {}, {}};
  for (int i = 0; i < 12; ++i) {
    image.rgba.emplace_back(0.1F * static_cast<float>(i), 0.5F, 0.02F, 1.0F);
    image.aov.push_back({vec3(0.0F, 1.0F, 0.0F), i == 0 ? INFINITY : 2.0F, i == 0 ? NO_OBJECT : 3U, 0, 0, 0});
  }
  return image;
}

TEST(DisplayValue, ShoulderIsContinuousMonotoneAndBounded) {
  EXPECT_NEAR(display_value(vec3(0.18F), 0.0).x, 0.4613F, 1e-3F);  // mid grey, sRGB
  EXPECT_NEAR(display_value(vec3(0.8001F), 0.0).x, display_value(vec3(0.7999F), 0.0).x, 1e-3F);
  float last = -1.0F;
  for (float x = 0.0F; x < 5.0F; x += 0.01F) {
    const float value = display_value(vec3(x), 0.0).x;
    EXPECT_GE(value, last);
    EXPECT_LE(value, 1.0F);
    last = value;
  }
  EXPECT_EQ(display_value(vec3(NAN, -1.0F, INFINITY), 0.0),
            vec3(0.0F, 0.0F, display_value(vec3(1e30F), 0.0).z));
  EXPECT_NEAR(display_value(vec3(0.1F), 1.0).x, display_value(vec3(0.2F), 0.0).x, 1e-6F);
}

TEST(Tones, KeepWhatADisplayCanShow) {
  const vec3 orange(0.6F, 0.3F, 0.1F);
  EXPECT_EQ(toned(orange, {0.0, Tone::none}), orange);
  EXPECT_EQ(toned(orange, {0.0, Tone::soft}), orange);
  // Khronos PBR Neutral takes 0.04 from colours whose least channel is at least 0.08: a dielectric's reflection.
  EXPECT_NEAR(glm::length(toned(orange, {0.0, Tone::neutral}) - (orange - 0.04F)), 0.0F, 1e-6F);
  for (const Tone tone : {Tone::soft, Tone::neutral, Tone::agx, Tone::none}) {
    float before = -1.0F;
    for (float x = 0.0F; x < 50.0F; x += 0.05F) {
      const vec3 grey = toned(vec3(x), {0.0, tone});
      EXPECT_GE(grey.x + 1e-3F, before) << TONE_NAMES[std::size_t(tone)] << " of " << x;
      EXPECT_TRUE(grey.x >= 0.0F && grey.x <= 1.0F);
      EXPECT_NEAR(grey.x, grey.z, 2e-3F);
      before = grey.x;
    }
    EXPECT_EQ(toned(vec3(NAN, -1.0F, 0.0F), {0.0, tone}).x, toned(vec3(0.0F), {0.0, tone}).x);
  }
}

TEST(Tones, AutomaticExposureMakesWhatIsSeenGrey) {
  Image image{2,
              2,
              {vec4(4.0F, 4.0F, 4.0F, 1.0F), vec4(1.0F, 1.0F, 1.0F, 1.0F), vec4(9e4F, 9e4F, 9e4F, 0.0F),
               vec4(0.0F, 0.0F, 0.0F, 1.0F)},
              {}};
  EXPECT_NEAR(automatic_exposure_ev(image), -3.0, 1e-6);
  image.rgba.assign(4, vec4(0.0F));
  EXPECT_EQ(automatic_exposure_ev(image), 0.0);
}

TEST(Tones, AutomaticExposureSparesTheBrightest) {
  Image image{100, 1, std::vector<vec4>(100, vec4(vec3(0.02F), 1.0F)), {}};
  for (std::size_t i = 80; i < 100; ++i) image.rgba[i] = vec4(vec3(0.4F), 1.0F);
  const auto shown = [&](float radiance) { return radiance * std::exp2(automatic_exposure_ev(image)); };
  EXPECT_GT(shown(0.02F), 0.13) << "a fifth is bright, but the rest is not left in the dark";
  for (std::size_t i = 0; i < 80; ++i) image.rgba[i] = vec4(vec3(0.08F), 1.0F);
  EXPECT_NEAR(shown(0.08F), 0.15, 1e-3) << "the darkest that the middle may be";
  for (std::size_t i = 0; i < 80; ++i) image.rgba[i] = vec4(vec3(0.12F), 1.0F);
  EXPECT_NEAR(shown(0.4F), 0.65, 1e-3) << "where both can be, neither is lost";
}

TEST(ImageFile, PngRoundTrip) {
  const std::string path = temporary("round.png");
  DisplayImage display = display_image(gradient(), 0.0);
  write_png(display, {}, path);
  quantise(display);
  const DisplayImage copy = read_display_image(path, 0.0);
  ASSERT_EQ(copy.rgb.size(), display.rgb.size());
  EXPECT_EQ(copy.width, 4U);
  for (std::size_t i = 0; i < copy.rgb.size(); ++i)
    EXPECT_LT(glm::length(copy.rgb[i] - display.rgb[i]), 1e-5F);
}

TEST(ImageFile, ExrKeepsLinearValuesAndIsAnEnvironment) {
  const std::string path = temporary("round.exr");
  const Image image = gradient();
  write_exr(image, aovs_of(image), {{"commit", "abc"}}, path);
  const Environment copy = read_environment(path);
  ASSERT_EQ(copy.texels.size(), image.rgba.size());
  for (std::size_t i = 0; i < copy.texels.size(); ++i) EXPECT_EQ(copy.texels[i], vec3(image.rgba[i]));
}

TEST(ImageFile, ExrHasTheAlbedo) {
  Image image = gradient();
  image.albedo.assign(image.rgba.size(), vec4(0.25F, 0.5F, 0.75F, 1.0F));
  EXPECT_TRUE(needs(aovs_of(image), AovSource::albedo));
  EXPECT_FALSE(needs(aovs_of(gradient()), AovSource::albedo));
  const std::string path = temporary("albedo.exr");
  write_exr(image, aovs_of(image), {}, path);
  const ExrPicture copy = read_exr(path);
  const auto green = std::find(copy.channels.begin(), copy.channels.end(), "albedo.G");
  ASSERT_NE(green, copy.channels.end());
  for (std::size_t pixel = 0; pixel < image.rgba.size(); ++pixel)
    EXPECT_EQ(copy.values[pixel * copy.channels.size() + std::size_t(green - copy.channels.begin())], 0.5F);
}

TEST(ImageFile, APngSaysThatItIsAPanorama) {
  const DisplayImage wide{4, 2, std::vector<vec3>(8)}, high{4, 3, std::vector<vec3>(12)};
  const auto said = [](const DisplayImage& image, const Metadata& metadata) {
    const std::vector<unsigned char> bytes = encode_png(image, metadata);
    const std::string text(bytes.begin(), bytes.end());
    return text.find("GPano:ProjectionType=\"equirectangular\"") != std::string::npos &&
           text.find("GPano:FullPanoWidthPixels=\"4\"") != std::string::npos;
  };
  EXPECT_TRUE(said(wide, {{"projection", "equirectangular"}}));
  EXPECT_FALSE(said(high, {{"projection", "equirectangular"}})) << "a part";
  EXPECT_FALSE(said(wide, {{"fov_y_deg", "30"}}));
}

TEST(ImageFile, AnEnvironmentsNonsenseIsCountedAndTakenAsDarkOrBright) {
  Image image = gradient();
  image.rgba[0].x = -1.0F;
  image.rgba[1].y = NAN;
  image.rgba[2].z = INFINITY;
  image.rgba[3].x = 1e6F;
  const std::string path = temporary("odd.exr");
  write_exr(image, 0, {}, path);
  std::string notes;
  const Environment sky = read_environment(path, [&notes](const std::string& note) { notes += note + '\n'; });
  EXPECT_EQ(sky.texels[0].x, 0.0F);
  EXPECT_EQ(sky.texels[1].y, 0.0F);
  EXPECT_EQ(sky.texels[2].z, 65504.0F);
  EXPECT_EQ(sky.texels[3].x, 1e6F);
  EXPECT_NE(notes.find("odd.exr': found 2 values that are negative or NaN"), std::string::npos) << notes;
  EXPECT_NE(notes.find("found 1 values that are infinite, expected radiance; taken as 65504"),
            std::string::npos);
}

TEST(ImageFile, KeepsMetadata) {
  const Metadata metadata = {{"command_line", "splatray-render 'a\xC3\xA9 \n\"b' --eye=1,2,3"},
                             {"seed", "1"}};
  const auto sorted = [](Metadata entries) {
    std::sort(entries.begin(), entries.end());
    return entries;
  };
  write_png(display_image(gradient(), 0.0), metadata, temporary("meta.png"));
  EXPECT_EQ(sorted(read_metadata(temporary("meta.png"))), metadata);
  write_exr(gradient(), 0, metadata, temporary("meta.exr"));
  EXPECT_EQ(sorted(read_metadata(temporary("meta.exr"))), metadata);
}

/// A header that says `width` x `height` before next to no pixels.
std::string forged_hdr(int width, int height) {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
         std::to_string(width) + "\n\2\2";
}

TEST(ImageFile, HeadersThatAskForMoreThanTheFileHoldsAreRefused) {
  const std::string path = temporary("forged.hdr");
  std::ofstream(path, std::ios::binary) << forged_hdr(6000, 6000);
  try {
    (void)read_environment(path);
    FAIL() << "read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::input_unreadable);
    EXPECT_NE(std::string(error.what()).find("forged.hdr': found 6000 x 6000 pixels"), std::string::npos)
        << error.what();
  }
}

TEST(ImageFile, AnEmptyFileIsSaidToBeEmpty) {
  for (const char* name : {"empty.png", "empty.hdr", "empty.exr"}) {
    const std::string path = temporary(name);
    std::ofstream(path, std::ios::trunc).close();
    try {
      (void)read_environment(path);
      FAIL() << "read " << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      EXPECT_NE(std::string(error.what()).find("found an empty file"), std::string::npos) << error.what();
    }
  }
}

/// An OpenEXR header of these attributes, each a name, a type and a value; `bytes` is what they say their values have.
std::string exr_header(const std::string& name, const std::string& type, std::uint32_t bytes,
                       const std::string& value) {
  const char* size = reinterpret_cast<const char*>(&bytes);
  return std::string("\x76\x2f\x31\x01\2\0\0\0", 8) + name + '\0' + type + '\0' + std::string(size, 4) +
         value + '\0';
}

/// Found by a fuzzer: OpenEXR took 1.9 GB for an attribute of a file of 400 bytes.
TEST(ImageFile, ExrHeadersAreCheckedBeforeOpenExrBelievesThem) {
  const std::string path = temporary("forged.exr");
  const auto refusal = [&path](const std::string& bytes) -> std::string {
    std::ofstream(path, std::ios::binary) << bytes;
    try {
      (void)read_environment(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      return error.what();
    }
    return "";
  };
  EXPECT_NE(
      refusal(exr_header("note", "string", 1868852842, "a")).find("an attribute 'note' of 1868852842 bytes"),
      std::string::npos);
  EXPECT_NE(refusal(exr_header("channels", "chlist", 9, "RR01234567")).find("of type chlist and 9 bytes"),
            std::string::npos);
  EXPECT_NE(refusal(exr_header("aspect", "float", 3, "abc")).find("of type float and 3 bytes"),
            std::string::npos);
  const std::string window("\0\0\0\0\0\0\0\0\xff\xff\xff\x7f\xff\xff\xff\x7f", 16);
  EXPECT_NE(refusal(exr_header("dataWindow", "box2i", 16, window)).find("2147483648 x 2147483648 pixels"),
            std::string::npos);
  EXPECT_NE(refusal(exr_header("views", "stringvector", 5, std::string("\0\0\0\x70x", 5))).find("a text of"),
            std::string::npos);
}

TEST(ImageFile, PicturesOfOneColourAreReadHoweverSmallTheirFile) {
  const DisplayImage black{2048, 2048, std::vector<vec3>(2048 * 2048)};
  write_png(black, {}, temporary("black.png"));
  EXPECT_EQ(read_display_image(temporary("black.png"), 0.0).width, 2048U);
  const Image dark{2048, 2048, std::vector<vec4>(2048 * 2048), {}};
  write_exr(dark, 0, {}, temporary("dark.exr"));
  EXPECT_EQ(read_display_image(temporary("dark.exr"), 0.0).width, 2048U);
}

TEST(ImageFile, UnwritableIsAnError) {
  EXPECT_THROW(write_png(display_image(gradient(), 0.0), {}, temporary("missing/a.png")), Error);
  EXPECT_THROW(write_exr(gradient(), 0, {}, temporary("missing/a.exr")), Error);
}

TEST(Compare, CountsWhatIsBeyond) {
  const DisplayImage picture = display_image(gradient(), 0.0);
  DisplayImage other = picture;
  EXPECT_TRUE(compare(picture, other, {}).passed);
  EXPECT_TRUE(std::isinf(compare(picture, other, {}).psnr_db));
  other.rgb[5].y += 0.01F;
  const Comparison one = compare(picture, other, {});
  EXPECT_NEAR(one.share, 1.0 / 12.0, 1e-12);
  EXPECT_NEAR(one.worst, 0.01, 1e-6);
  EXPECT_NEAR(one.psnr_db, -10.0 * std::log10(1e-4 / 36.0), 1e-3);
  EXPECT_FALSE(one.passed);
  EXPECT_TRUE(compare(picture, other, {0.004, 0.1, 0.012}).passed);
  EXPECT_FALSE(compare(picture, other, {0.004, 0.1, 0.009}).passed);
  EXPECT_NEAR(one.difference.rgb[5].y, 0.1F, 1e-5F);
}

/// A picture whose colours rise by `rise` from one side to the other; with alpha that rises by a half.
DisplayImage slope(float rise, bool with_alpha) {
  DisplayImage image{64, 48, {}};
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const float right = static_cast<float>(x) / 64.0F, down = static_cast<float>(y) / 48.0F;
      image.rgb.emplace_back(0.3F + rise * right, 0.3F + rise * down, 0.4F);
      if (with_alpha) image.alpha.push_back(0.5F + 0.5F * right);
    }
  return image;
}

void write_bytes(const std::string& path, const std::vector<unsigned char>& bytes, std::size_t count) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(count));
}

TEST(DisplayFormats, AreReadAgainWithWhatTheyKeep) {
  const Metadata kept{{"command_line", "splatray-render a.ply -o 'a b.jpg'"},
                      {"seed", std::string(301, '7')}};
  for (const char* name : {"a.png", "a.jpg", "a.JPEG", "a.webp"})
    for (const bool with_alpha : {false, true}) {
      const std::string path = temporary(name);
      const bool is_webp = path.ends_with("webp");
      const DisplayImage image =
          slope(is_webp ? 0.0F : 0.5F, with_alpha);  // pixels of a WebP share their hues
      const auto bytes = encode_display(image, kept, path);
      write_bytes(path, bytes, bytes.size());
      EXPECT_EQ(read_metadata(path), kept) << name << with_alpha;
      EXPECT_TRUE(is_whole_picture(path)) << name;
      const DisplayImage again = read_display_image(path, {});
      ASSERT_EQ(again.rgb.size(), image.rgb.size()) << name;
      // Three channels are rounded by half a step of PNG, by up to three of the others. OpenImageIO multiplies what it reads of a WebP
      // by alpha, and divides what it writes, which rounds by two steps more.
      const float steps = path.ends_with("png") ? 0.5F : (is_webp && with_alpha ? 5.0F : 3.0F);
      const float most = steps * std::sqrt(3.0F) / 255.0F;
      for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        const float alpha = is_webp && with_alpha ? image.alpha[i] : 1.0F;
        ASSERT_LE(glm::length(again.rgb[i] - alpha * image.rgb[i]), most) << name << i;
      }
      write_bytes(path, bytes, bytes.size() - 40);
      EXPECT_FALSE(std::string(name) != "a.webp" && is_whole_picture(path)) << name;
    }
}

TEST(DisplayFormats, AJpegLeavesOutWhatNoCommentHolds) {
  const Metadata kept{{"long", std::string(70000, 'x')}, {"seed", "1"}};
  const std::string path = temporary("long.jpg");
  const auto bytes = encode_display(slope(0.5F, false), kept, path);
  write_bytes(path, bytes, bytes.size());
  EXPECT_EQ(read_metadata(path), (Metadata{{"seed", "1"}}));
}

}  // namespace
}  // namespace splatray
