/// VTK's own formats.
#include <cmath>

#include "engine/base/srgb.h"
#include "tests/readers/read_error.h"

namespace splatray {
namespace {

const char* const VTP =
    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\"><PolyData><Piece "
    "NumberOfPoints=\"2\" "
    "NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\"><PointData "
    "Normals=\"N\" "
    "Scalars=\"C\"><DataArray type=\"Float32\" Name=\"N\" NumberOfComponents=\"3\" format=\"ascii\">0 0 1 0 "
    "1 "
    "0</DataArray><DataArray type=\"UInt8\" Name=\"C\" NumberOfComponents=\"3\" format=\"ascii\">255 0 128 0 "
    "0 "
    "0</DataArray><DataArray type=\"Float64\" Name=\"radius\" format=\"ascii\">0.5 "
    "0.25</DataArray></PointData>"
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">4000000.001 0 0 1 2 "
    "3</DataArray></Points></Piece></PolyData></VTKFile>\n";

TEST(Vtk, VtpKeepsDoublesNormalsColoursAndRadii) {
  const TempFolder folder;
  const Points points = read_input({folder.write("p.vtp", VTP)}, {}).objects[0].points;
  ASSERT_EQ(points.size(), 2U);
  EXPECT_DOUBLE_EQ(points.position[0].x, 4000000.001);
  EXPECT_FLOAT_EQ(points.normal[1].y, 1.0F);
  EXPECT_NEAR(points.color[0].z, 0.2158605F, 1e-6F);
  EXPECT_FLOAT_EQ(points.radius[1], 0.25F);
}

/// The red of a middle grey, 0.2 for display, that these arrays give two points; NaN where they give no colours.
float grey_of(const std::string& arrays) {
  const TempFolder folder;
  const Points points =
      read_input({folder.write(
                     "p.vtp",
                     "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\"><PolyData>"
                     "<Piece NumberOfPoints=\"2\"><PointData>" +
                         arrays +
                         "</PointData><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
                         "format=\"ascii\">0 0 0 1 2 3</DataArray></Points></Piece></PolyData></VTKFile>")},
                 {})
          .objects[0]
          .points;
  return points.color.empty() ? NAN : points.color[0].x;
}

std::string color_array(const std::string& type, const std::string& name, const std::string& grey,
                        const std::string& full) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"3\" format=\"ascii\">" +
         grey + " " + grey + " " + grey + " " + full + " 0 0</DataArray>";
}

TEST(Vtk, ColoursOfAnyTypeAreScaledByTheirValues) {
  const float grey = srgb_to_linear(0.2F);
  EXPECT_NEAR(grey_of(color_array("UInt8", "RGB", "51", "255")), grey, 1e-6F) << "not the active scalars";
  EXPECT_NEAR(grey_of(color_array("Float32", "Colors", "0.2", "1")), grey, 1e-6F);
  EXPECT_NEAR(grey_of(color_array("Float64", "rgb", "51", "255")), grey, 1e-6F);
  EXPECT_NEAR(grey_of(color_array("UInt16", "Diffuse Color", "13107", "65535")), grey, 1e-6F);
  EXPECT_NEAR(grey_of(color_array("UInt16", "RGB", "51", "255")), grey, 1e-6F) << "8 bits in 16";
  EXPECT_TRUE(std::isnan(grey_of(color_array("Float32", "velocity", "0.2", "1"))));
  std::string channels;
  for (const char* name : {"Red", "Green", "Blue"})
    channels +=
        std::string("<DataArray type=\"Int32\" Name=\"") + name + "\" format=\"ascii\">51 255</DataArray>";
  EXPECT_NEAR(grey_of(channels), grey, 1e-6F);
}

TEST(Vtk, VtpFacesBeyondTheirArraysAreErrors) {
  const TempFolder folder;
  const auto with_face = [&](const std::string& connectivity, const std::string& offsets) {
    std::string text = VTP;
    text.replace(text.find("NumberOfPolys=\"0\""), 17, "NumberOfPolys=\"1\"");
    text.insert(text.find("</Piece>"),
                "<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" + connectivity +
                    "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + offsets +
                    "</DataArray></Polys>");
    return folder.write("f.vtp", text);
  };
  EXPECT_EQ(read_input({with_face("0 1 0", "3")}, {}).objects[0].points.size(), 2U);
  static_cast<void>(read_error(with_face("0 1 77", "3")));
  static_cast<void>(read_error(with_face("0 1 0", "3000000")));
}

/// A DataArray of XML as text; `more` stands in its tag.
std::string array(const std::string& type, const std::string& name, const std::string& values,
                  const std::string& more = "") {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\"" + more + ">" + values +
         "</DataArray>";
}

/// A .vtu with one piece.
std::string vtu(int points, const std::string& places, int cells, const std::string& connectivity,
                const std::string& offsets, const std::string& types, const std::string& point_data = "",
                const std::string& more_cells = "") {
  return "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
         "<Piece NumberOfPoints=\"" +
         std::to_string(points) + "\" NumberOfCells=\"" + std::to_string(cells) + "\"><PointData>" +
         point_data + "</PointData><Points>" +
         array("Float64", "Points", places, " NumberOfComponents=\"3\"") + "</Points><Cells>" +
         array("Int64", "connectivity", connectivity) + array("Int64", "offsets", offsets) +
         array("UInt8", "types", types) + more_cells + "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

/// The corners of squares across x, at each of `count` whole numbers from `first` on.
std::string bar_places(int first, int count) {
  std::string places;
  for (int x = first; x < first + count; ++x)
    for (const char* corner : {" 0 0 ", " 1 0 ", " 1 1 ", " 0 1 "}) places += std::to_string(x) + corner;
  return places;
}

/// Two cubes in a row, of 12 points.
std::string two_cubes(const std::string& point_data = "") {
  return vtu(12, bar_places(0, 3), 2, "0 1 2 3 4 5 6 7 4 5 6 7 8 9 10 11", "8 16", "12 12", point_data);
}

std::string one_cube(int first) { return vtu(8, bar_places(first, 2), 1, "0 1 2 3 4 5 6 7", "8", "12"); }

/// How the triangles of the only object are read.
struct Faces {
  std::size_t triangles = 0;
  double area = 0.0;
};
Faces faces_of(const std::filesystem::path& path) {
  const Input input = read_input({path}, keeping_meshes());
  return {input.objects[0].meshes.at(0).triangles.size(), input.objects[0].surface_area};
}

TEST(Vtk, VolumesShowTheirOuterFacesWithTheArraysOfTheirPoints) {
  const TempFolder folder;
  const auto file =
      folder.write("two.vtu", two_cubes(array("Float32", "pressure", "0 0 0 0 5 5 5 5 10 10 10 10")));
  const Faces faces = faces_of(file);
  EXPECT_EQ(faces.triangles, 20U);
  EXPECT_NEAR(faces.area, 10.0, 1e-9);
  const Points points = read_input({file}, keeping_meshes()).objects[0].points;
  const Column* pressure = find_column(points.columns, "pressure");
  ASSERT_NE(pressure, nullptr);
  ASSERT_EQ(pressure->size(), points.size());
  bool between = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    between = between || std::abs(points.position[i].x - std::round(points.position[i].x)) > 0.1;
    // whole numbers to 255 are kept in bytes, of the nearest corner
    EXPECT_NEAR(pressure->number(i), 5.0 * points.position[i].x, 5.0 * 2.0 / 3.0 + 1e-6);
  }
  EXPECT_TRUE(between);
}

TEST(Vtk, NumbersWithAFractionAreInterpolatedOnFaces) {
  const TempFolder folder;
  const auto file = folder.write(
      "t.vtu", vtu(3, "0 0 0 1 0 0 0 1 0", 1, "0 1 2", "3", "5", array("Float64", "t", "0.125 1.125 0.125")));
  const Points points = read_input({file}, keeping_meshes()).objects[0].points;
  const Column* t = find_column(points.columns, "t");
  ASSERT_NE(t, nullptr);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(t->number(i), 0.125 + points.position[i].x, 1e-6);
}

TEST(Vtk, PointsOfGridsWithoutFacesKeepVectorsByComponent) {
  const TempFolder folder;
  const auto file =
      folder.write("p.vtu", vtu(2, "0 0 0 1 2 3", 2, "0 1", "1 2", "1 1",
                                array("Float32", "v", "3 4 0 0 0 1", " NumberOfComponents=\"3\"") +
                                    array("Float32", "q", "1 2 3 4 5 6 7 8", " NumberOfComponents=\"4\"")));
  const Points points = read_input({file}, {}).objects[0].points;
  ASSERT_EQ(points.size(), 2U);
  for (const auto& [name, value] :
       {std::pair("v_X", 3.0), {"v_Y", 4.0}, {"v_Magnitude", 5.0}, {"q_3", 4.0}}) {
    const Column* column = find_column(points.columns, name);
    ASSERT_NE(column, nullptr) << name;
    EXPECT_EQ(column->number(0), value) << name;
  }
}

TEST(Vtk, PolyhedraAndWrongCells) {
  const TempFolder folder;
  const std::string places = "0 0 0 1 0 0 0 1 0 0 0 1";
  const auto polyhedron = [&](const std::string& faces) {
    return folder.write("p.vtu", vtu(4, places, 1, "0 1 2 3", "4", "42", "",
                                     array("Int64", "faces", faces) + array("Int64", "faceoffsets", "17")));
  };
  EXPECT_EQ(faces_of(polyhedron("4 3 0 2 1 3 0 1 3 3 1 2 3 3 0 3 2")).triangles, 4U);
  EXPECT_NE(read_error(polyhedron("4 3 0 2 1 3 0 1 3 3 1 2 3 3 0 3 77")).find("faces of polyhedron 0"),
            std::string::npos);
  static_cast<void>(
      read_error(polyhedron("4 3 0 2 1 3 0 1 3 3 1 2 3 90 0 3 2")));  // VTK's reader finds this itself
  // VTK writes as many faces as there are where the offsets left room for one number.
  const std::string far = folder.write(
      "f.vtu",
      vtu(4, places, 1, "0 1 2 3", "4", "42", "",
          array("Int64", "faces", "4 3 0 2 1 3 0 1 3 3 1 2 3 3 0 3 2") + array("Int64", "faceoffsets", "1")));
  EXPECT_NE(read_error(far).find("lists of polyhedra's faces"), std::string::npos) << read_error(far);
  EXPECT_NE(
      read_error(folder.write("h.vtu", vtu(4, places, 1, "0 1 2 3", "4", "12"))).find("4 points, expected 8"),
      std::string::npos);
  EXPECT_NE(read_error(folder.write("i.vtu", vtu(4, places, 1, "0 1 2 9", "4", "10"))).find("vertex 9"),
            std::string::npos);
  EXPECT_NE(read_error(folder.write("l.vtu", vtu(4, places, 1, "0 1 2 3", "4", "70"))).find("type 70"),
            std::string::npos);
}

TEST(Vtk, PiecesAreOneWhole) {
  const TempFolder folder;
  const auto list = [&](const std::string& name, const std::string& kind,
                        const std::vector<std::string>& pieces) {
    std::string text = "<VTKFile type=\"P" + kind + "\" version=\"1.0\"><P" + kind + ">";
    for (const std::string& piece : pieces) text += "<Piece Source=\"" + piece + "\"/>";
    return folder.write(name, text + "</P" + kind + "></VTKFile>\n");
  };
  folder.write("a.vtu", one_cube(0));
  folder.write("b.vtu", one_cube(1));
  const Faces faces = faces_of(list("two.pvtu", "UnstructuredGrid", {"a.vtu", "b.vtu"}));
  EXPECT_NEAR(faces.area, 10.0, 1e-9) << "no face between the two";
  folder.write("a.vtp", VTP);
  EXPECT_EQ(read_input({list("p.pvtp", "PolyData", {"a.vtp", "a.vtp"})}, {}).objects[0].points.size(), 4U);
  const auto wrong = [&](const std::string& piece) {
    return read_error(list("w.pvtu", "UnstructuredGrid", {piece}));
  };
  EXPECT_NE(wrong("../a.vtu").find("in its folder or below"), std::string::npos);
  EXPECT_NE(wrong("/etc/passwd").find("in its folder or below"), std::string::npos);
  EXPECT_NE(wrong("w.pvtu").find("expected a .vtu"), std::string::npos);
  EXPECT_NE(read_error(list("n.pvtu", "UnstructuredGrid", {})).find("no pieces"), std::string::npos);
}

std::string legacy(const std::string& version) { return "# vtk DataFile Version " + version + "\na title\n"; }

const std::string LEGACY = legacy("3.0");
const std::string LEGACY_SQUARE =
    LEGACY +
    "ASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\nPOLYGONS 1 5\n4 0 1 2 3\nPOINT_DATA "
    "4\n"
    "SCALARS height float 1\nLOOKUP_TABLE default\n0 0.5 1.5 2\nFIELD more 1\nage 1 4 int\n7 8 9 10\n";

template <class Value>
std::string big_endian(std::initializer_list<Value> values) {
  std::string bytes;
  for (const Value value : values) {
    const std::string little = bytes_of(value);
    bytes.append(little.rbegin(), little.rend());
  }
  return bytes;
}

/// A triangle; cells as versions before 5 (`list`) or since write them.
std::string legacy_triangle(bool list) {
  return legacy(list ? "4.2" : "5.1") + "BINARY\nDATASET POLYDATA\nPOINTS 3 float\n" +
         big_endian<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + "\n" +
         (list ? "POLYGONS 1 4\n" + big_endian<std::int32_t>({3, 0, 1, 2})
               : "POLYGONS 2 3\nOFFSETS vtktypeint64\n" + big_endian<std::int64_t>({0, 3}) +
                     "\nCONNECTIVITY vtktypeint64\n" + big_endian<std::int64_t>({0, 1, 2})) +
         "\nPOINT_DATA 3\nFIELD f 1\nheat 1 3 float\n" + big_endian<float>({0.25F, 0.5F, 0.75F}) + "\n";
}

TEST(Vtk, LegacyFilesOfAllKindsAreRead) {
  const TempFolder folder;
  const auto square = folder.write("s.vtk", LEGACY_SQUARE);
  EXPECT_EQ(faces_of(square).triangles, 2U);
  const Points points = read_input({square}, keeping_meshes()).objects[0].points;
  EXPECT_NE(find_column(points.columns, "height"), nullptr);
  EXPECT_NE(find_column(points.columns, "age"), nullptr);
  for (const bool list : {true, false}) {
    const auto triangle = folder.write("t.vtk", legacy_triangle(list));
    EXPECT_NEAR(faces_of(triangle).area, 0.5, 1e-9) << list;
    EXPECT_NE(find_column(read_input({triangle}, keeping_meshes()).objects[0].points.columns, "heat"),
              nullptr);
  }
  const std::string cube = "POINTS 8 double\n" + bar_places(0, 2) + "\n";
  const auto grid = folder.write("u.vtk", LEGACY + "ASCII\nDATASET UNSTRUCTURED_GRID\n" + cube +
                                              "CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n");
  EXPECT_NEAR(faces_of(grid).area, 6.0, 1e-9);
  const auto curves = folder.write(
      "c.vtk",
      LEGACY + "ASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 2 2 1\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 1 1 0\n");
  EXPECT_NEAR(faces_of(curves).area, 1.0, 1e-9);
  const auto axes =
      folder.write("r.vtk", LEGACY +
                                "ASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS 2 2 2\nX_COORDINATES 2 float\n"
                                "0 1\nY_COORDINATES 2 float\n0 2\nZ_COORDINATES 2 float\n0 3\n");
  EXPECT_NEAR(faces_of(axes).area, 22.0, 1e-9);
}

TEST(Vtk, LegacyFilesKeepAllArraysOfEachKind) {
  const TempFolder folder;
  std::string values;
  for (const char* name : {"a", "b"})
    values += std::string("SCALARS s") + name + " float 1\nLOOKUP_TABLE default\n0 1 2 3\nVECTORS v" + name +
              " float\n1 0 0 1 0 0 1 0 0 1 0 0\nFIELD f" + name + " 1\nx" + name + " 1 4 int\n7 8 9 10\n";
  const auto file = folder.write(
      "p.vtk", LEGACY +
                   "ASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\nPOINT_DATA "
                   "4\n" +
                   values + "COLOR_SCALARS colors 3\n1 0 0 1 0 0 1 0 0 1 0 0\n");
  const Points points = read_input({file}, {}).objects[0].points;
  for (const char* name : {"sa", "sb", "va_X", "vb_X", "xa", "xb"})
    EXPECT_NE(find_column(points.columns, name), nullptr) << name;
  ASSERT_FALSE(points.color.empty());
  EXPECT_EQ(points.color[0], glm::vec3(1, 0, 0));
}

TEST(Vtk, WhatIsNotReadIsNamed) {
  const TempFolder folder;
  std::string text = VTP;
  text.insert(text.find("<PolyData>") + 10,
              "<FieldData>" + array("Float64", "TimeValue", "2.5", " NumberOfTuples=\"1\"") + "</FieldData>");
  text.insert(text.find("</PointData>"),
              "<Array type=\"String\" Name=\"label\" format=\"ascii\">65 0 66 0</Array>");
  const Input input = read_input({folder.write("p.vtp", text)}, {});
  EXPECT_TRUE(has_note(input, "skipped field data 'TimeValue'"));
  EXPECT_TRUE(has_note(input, "without one number for each point: 'label'"));
  const Input square =
      read_input({folder.write("s.vtk", LEGACY_SQUARE +
                                            "CELL_DATA 1\nSCALARS quality float\nLOOKUP_TABLE default\n1\n")},
                 keeping_meshes());
  EXPECT_TRUE(has_note(square, "skipped values of cells: 'quality'"));
  EXPECT_TRUE(read_input({folder.write("q.vtp", VTP)}, {}).notes.empty());
}

TEST(Vtk, AsManyArraysAreKeptAsScenesHaveAttributes) {
  const TempFolder folder;
  const auto read = [&](std::size_t count) {
    std::string text = VTP, arrays;
    for (std::size_t i = 0; i < count; ++i) arrays += array("Float32", "a" + std::to_string(i), "1 2");
    return read_input({folder.write("a.vtp", text.insert(text.find("</PointData>"), arrays))}, {});
  };
  const Input all = read(COLUMNS_MOST), more = read(COLUMNS_MOST + 1);
  EXPECT_EQ(all.objects[0].points.columns.size(), COLUMNS_MOST);
  EXPECT_TRUE(all.notes.empty());
  EXPECT_EQ(more.objects[0].points.columns.size(), COLUMNS_MOST);
  EXPECT_TRUE(has_note(more, "1 arrays are left out"));
}

TEST(Vtk, WhatAPieceSaysOfAllItsPointsIsNamed) {
  const TempFolder folder;
  std::string piece = VTP;
  piece.insert(piece.find("<Piece"),
               "<FieldData><Array type=\"String\" Name=\"crs\" NumberOfTuples=\"1\" format=\"ascii\">65 "
               "0</Array></FieldData>");
  folder.write("a.vtp", piece);
  const auto list = [&](const std::string& pieces) {
    return read_input({folder.write("p.pvtp", "<VTKFile type=\"PPolyData\" version=\"1.0\"><PPolyData>" +
                                                  pieces + "</PPolyData></VTKFile>")},
                      {});
  };
  const std::string one = "<Piece Source=\"a.vtp\"/>";
  EXPECT_EQ(list(one).crs, "A");
  EXPECT_TRUE(has_note(list(one + one), "as it is a piece"));
}

/// VTK's reader (9.1) wrote behind the end of arrays of texts, and read through null pointers to say that an array is short.
TEST(Vtk, ArraysOfMoreOrFewerValuesThanTheySayAreNoFaults) {
  const TempFolder folder;
  std::string texts;
  for (int i = 0; i < 3000; ++i) texts += "65 0 ";
  const auto text_array = [](const std::string& values, const std::string& more) {
    return "<Array type=\"String\" Name=\"label\" format=\"ascii\"" + more + ">" + values + "</Array>";
  };
  const auto with = [&](const std::string& before, const std::string& more) {
    std::string text = VTP;
    return folder.write("a.vtp", text.insert(text.find(before), more));
  };
  const auto field = [&](const std::string& values, const std::string& count) {
    return with("<Piece",
                "<FieldData>" + text_array(values, " NumberOfTuples=\"" + count + "\"") + "</FieldData>");
  };
  EXPECT_EQ(read_input({field(texts, "1")}, {}).objects[0].points.size(), 2U);
  EXPECT_NE(read_error(with("<Piece", "<FieldData>" + array("Text", "odd", "1") + "</FieldData>"))
                .find("of type 'Text'"),
            std::string::npos);
  EXPECT_NE(read_error(field("65 0", "9")).find("fewer values of 'label'"), std::string::npos);
  EXPECT_EQ(read_input({with("</PointData>", text_array(texts, ""))}, {}).objects[0].points.size(), 2U);
  EXPECT_NE(read_error(with("</PointData>", text_array("65 0", ""))).find("fewer values of 'label'"),
            std::string::npos);
  EXPECT_NE(read_error(with("</PointData>", array("Float32", "short", "1"))).find("fewer values of 'short'"),
            std::string::npos);
  std::string cells = vtu(3, "0 0 0 1 0 0 0 1 0", 1, "0 1 2", "3", "5");
  cells.replace(cells.find("<PointData></PointData>"), 23,
                "<CellData>" + array("Float32", "short", "") + "</CellData>");
  EXPECT_NE(read_error(folder.write("c.vtu", cells)).find("fewer values of 'short'"), std::string::npos);
}

TEST(Vtk, LegacyFilesThatLieAreRefused) {
  const TempFolder folder;
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = LEGACY_SQUARE;
    text.replace(text.find(from), from.size(), to);
    return read_error(folder.write("s.vtk", text));
  };
  EXPECT_NE(changed("POINTS 4 ", "POINTS 4000000000 ").find("fits a file of"), std::string::npos);
  EXPECT_NE(changed("4 0 1 2 3", "4000000 1 2 3").find("fits a file of"), std::string::npos);
  EXPECT_NE(changed("4 0 1 2 3", "9 0 1 2 3").find("within a list of 5"), std::string::npos);
  EXPECT_NE(changed("4 0 1 2 3", "4 0 1 2 7").find("vertex 7"), std::string::npos);
  EXPECT_NE(changed("1 4 int", "99 4 int").find("within the file"), std::string::npos);
  EXPECT_NE(changed("4 int", "4 string").find("of type 'string'"), std::string::npos);
  EXPECT_NE(changed("Version 3.0", "Version 5.1").find("expected offsets"), std::string::npos);
  EXPECT_NE(changed("POLYDATA", "STRUCTURED_POINTS").find("'structured_points'"), std::string::npos);
  EXPECT_NE(changed("POLYGONS", "POLYGNS").find("'polygns'"), std::string::npos);
  std::string binary = legacy_triangle(true);
  binary.replace(binary.find(big_endian<std::int32_t>({3, 0})), 4, big_endian<std::int32_t>({0x7FFFFFFF}));
  EXPECT_NE(read_error(folder.write("b.vtk", binary)).find("found a cell of 2147483647 points"),
            std::string::npos);
  // an array of fewer values than there are points is left out
  std::string few = LEGACY_SQUARE;
  few.replace(few.find("age 1 4 int\n7 8 9 10"), 20, "age 1 2 int\n7 8");
  EXPECT_EQ(find_column(read_input({folder.write("f.vtk", few)}, keeping_meshes()).objects[0].points.columns,
                        "age"),
            nullptr);
}

TEST(Vtk, BrokenFilesAreErrorsAndNothingIsPrinted) {
  const TempFolder folder;
  ::testing::internal::CaptureStderr();
  read_every_prefix(folder, "p.vtp", std::string(VTP).substr(0, 400));
  read_every_prefix(folder, "t.vtu", two_cubes());
  read_every_prefix(folder, "s.vtk", LEGACY_SQUARE);
  for (const bool list : {true, false}) read_every_prefix(folder, "t.vtk", legacy_triangle(list));
  static_cast<void>(read_error(folder.write("x.vtp", "this is not XML")));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Vtk, ListsOfCellsHoldWholeNumbers) {
  const TempFolder folder;
  const auto with_vertex = [&](const std::string& kind, const std::string& cells, const std::string& vertex) {
    return folder.write("a.vtk", "# vtk DataFile Version 3.0\na title\nASCII\nDATASET " + kind +
                                     "\nPOINTS 3 float\n0 0 0 1 0 0 1 1 0\n" + cells + " 1 4\n3 0 1 " +
                                     vertex + (kind == "POLYDATA" ? "\n" : "\nCELL_TYPES 1\n5\n"));
  };
  for (const auto& [kind, cells] : {std::pair("POLYDATA", "POLYGONS"), {"UNSTRUCTURED_GRID", "CELLS"}}) {
    EXPECT_EQ(faces_of(with_vertex(kind, cells, "2")).triangles, 1U);
    for (const std::string vertex : {"x", "nan", "1.5", "-1", "4294967296", "99999999999999999999"})
      EXPECT_NE(read_error(with_vertex(kind, cells, vertex)).find("vertex"), std::string::npos) << vertex;
    static_cast<void>(read_error(with_vertex(kind, cells, std::string("\0", 1))));
    static_cast<void>(read_error(with_vertex(kind, cells, "")));
  }
}

}  // namespace
}  // namespace splatray
