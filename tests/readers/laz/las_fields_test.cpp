/// What records of LAS files hold beside positions and the usual attributes: normals, radii, further fields, extra bytes.
#include "tests/readers/las_file.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

/// The input that a file of these bytes is, with these attributes asked for.
Input input_of(const std::string& bytes, const std::vector<std::string>& attributes = {}) {
  const TempFolder folder;
  ReadOptions options;
  options.scans.attributes = attributes;
  return read_input({folder.write("a.las", bytes)}, options);
}

/// Two points with the extra bytes that these descriptors are of, `extra` in the first and zeros in the second.
std::string with_extra(const std::string& descriptors, const std::string& extra) {
  LasFile file;
  file.records = {las_point(1000, 2000, 3000), las_point(-1000, 0, 7)};
  file.vlrs = {las_vlr("LASF_Spec", 4, descriptors)};
  file.extra_bytes = extra.size();
  file.records[0].extra = extra;
  file.records[1].extra = std::string(extra.size(), '\0');
  return file.bytes();
}

TEST(LasFields, NormalsAndRadiiOfExtraBytesAreThePoints) {
  const std::string normal = bytes_of(0.6F) + bytes_of(0.0F) + bytes_of(-0.8F);
  const auto three = [](const std::string& x, const std::string& y, const std::string& z) {
    return las_descriptor(9, x) + las_descriptor(9, y) + las_descriptor(9, z);
  };
  for (const std::string& descriptors :
       {three("NormalX", "NormalY", "NormalZ"), three("Nx", "Ny", "Nz"),
        three("normal_x", "normal_y", "normal_z"), three("nx", "ny", "nz"),
        three("normal[0]", "normal[1]", "normal[2]"), las_descriptor(29, "Normal")}) {
    const Input input =
        input_of(with_extra(descriptors + las_descriptor(9, "Radius"), normal + bytes_of(0.25F)));
    const Points& points = input.objects.at(0).points;
    EXPECT_EQ(points.normal, (std::vector<glm::vec3>{{0.6F, 0.0F, -0.8F}, glm::vec3(0.0F)})) << descriptors;
    EXPECT_EQ(points.radius, (std::vector<float>{0.25F, 0.0F})) << descriptors;
    EXPECT_TRUE(points.columns.size() == 2U) << "return and returns alone";
  }
}

TEST(LasFields, NormalsMayBeScaledIntegers) {
  const auto one = [](const char* name) { return las_descriptor(4, name, 8, 0.5); };
  const std::string numbers =
      bytes_of<std::int16_t>(-2) + bytes_of<std::int16_t>(0) + bytes_of<std::int16_t>(0);
  const Input input = input_of(with_extra(one("NormalX") + one("NormalY") + one("NormalZ"), numbers));
  ASSERT_EQ(input.objects.at(0).points.normal.size(), 2U);
  EXPECT_EQ(input.objects[0].points.normal[0], glm::vec3(-1.0F, 0.0F, 0.0F));
}

TEST(LasFields, NormalsThatLackAnAxisOrAreZeroAreNone) {
  const std::string two = las_descriptor(9, "NormalX") + las_descriptor(9, "NormalY");
  EXPECT_TRUE(input_of(with_extra(two, bytes_of(1.0F) + bytes_of(0.0F))).objects.at(0).points.normal.empty());
  const std::string zeros = las_descriptor(29, "Normal") + las_descriptor(9, "radius");
  const Input input = input_of(with_extra(zeros, std::string(16, '\0')));
  EXPECT_TRUE(input.objects.at(0).points.normal.empty());
  EXPECT_TRUE(input.objects.at(0).points.radius.empty());
}

}  // namespace
}  // namespace splatray
