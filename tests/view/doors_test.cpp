/// One request through every door: the same pixels, choices and metadata.
#include <fstream>
#include <map>

#include "app/library/image_file.h"
#include "app/library/request/command_line.h"
#include "app/library/shot/picture_lights.h"
#include "app/library/shot/resolve.h"
#include "app/library/shot/scene_source.h"
#include "app/library/splatray.h"
#include "app/view/model/document_request.h"
#include "app/view/model/navigation.h"
#include "app/view/model/region_edit.h"
#include "app/view/model/section_sheet.h"
#include "app/view/thread/save.h"
#include "engine/device/device.h"
#include "preprocess/base/file_extension.h"
#include "tests/cli/child_process.h"
#include "tests/view/live_documents.h"

namespace splatray {
namespace {

/// A box of 4 x 5 x 3 seen from its middle, as a sensor there saw it.
std::string scan_pcd() {
  constexpr int SIDE = 24;
  std::string rows;
  int count = 0;
  for (int face = 0; face < 6; ++face)
    for (int i = 0; i < SIDE; ++i)
      for (int j = 0; j < SIDE; ++j) {
        const glm::dvec3 half(2.0, 2.5, 1.5);
        const int axis = face / 2;
        glm::dvec3 place;
        place[axis] = (face % 2 == 0 ? -1.0 : 1.0) * half[axis];
        place[(axis + 1) % 3] = ((i + 0.5) / SIDE * 2.0 - 1.0) * half[(axis + 1) % 3];
        place[(axis + 2) % 3] = ((j + 0.5) / SIDE * 2.0 - 1.0) * half[(axis + 2) % 3];
        rows +=
            std::to_string(place.x) + " " + std::to_string(place.y) + " " + std::to_string(place.z) + "\n";
        ++count;
      }
  const std::string points = std::to_string(count);
  return "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + points +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA ascii\n" + rows;
}

/// A triangle of brass.
std::string triangle_gltf() {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"materials":[{"doubleSided":true,
"pbrMetallicRoughness":{"baseColorFactor":[0.9,0.7,0.3,1],"metallicFactor":0.8,"roughnessFactor":0.4}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,
"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

/// What a picture's file says but for who wrote it by which command, when.
std::map<std::string, std::string> said_in(const std::filesystem::path& picture, bool choices = true) {
  std::map<std::string, std::string> said;
  for (const auto& [name, value] : read_metadata(picture))
    if (name != "command_line" && name != "commit" && (choices || name != "choices")) said[name] = value;
  return said;
}

class Doors : public CliTest {
 protected:
  Doors() {
    write("room.pcd", scan_pcd());
    write("cube.obj", cube_obj());
    write("grid.ply", grid_ply(true));
    write("brass.gltf", triangle_gltf());
    write("lamp.gltf", lamp_gltf(300.0));
  }

  /// The file that splatray-render makes of a scene of the folder, and the request that it was given.
  std::string by_program(const std::string& scene, const std::string& options, const std::string& name) {
    std::vector<std::string> words{RENDER, "--quiet", "--device=cpu", file(scene)};
    const std::vector<std::string> more = shell_words(options + " -o " + name);
    words.insert(words.end(), more.begin(), more.end() - 1);
    words.push_back(file(name));
    const ChildResult result = run_program(words);
    EXPECT_EQ(result.code, 0) << options << ": " << result.err;
    words.insert(words.end(), {"--save-request", file(name + ".json")});
    EXPECT_EQ(run_program(words).code, 0);
    return file(name);
  }

  /// The same request's file by JSON and by C++; expects them to be the program's.
  void expect_same(const std::string& scene, const std::string& options, const std::string& extension) {
    const std::string asked = "asked" + extension;
    const std::string made = by_program(scene, options, asked);
    const std::string by_json = file("json" + extension), by_api = file("api" + extension);
    const ChildResult json =
        run_program({RENDER, "--quiet", "--request", file(asked + ".json"), "-o", by_json});
    EXPECT_EQ(json.code, 0) << json.err;
    const api::Request request = api::Request::from_json(text_of_file(asked + ".json")).set("output", by_api);
    const api::Scene opened = api::open(std::filesystem::path(file(scene)), request);
    const api::Made done = api::make(opened, request);
    EXPECT_EQ(done.files, std::vector<std::filesystem::path>{by_api});
    for (const std::string& other : {by_json, by_api}) expect_equal(made, other, options);
    const bool keeps = extension != ".html";
    EXPECT_TRUE(!keeps || said_in(made)["choices"] == choices_text_of(done.choices)) << options;
    std::filesystem::remove(made);
    std::filesystem::remove(by_json);
    std::filesystem::remove(by_api);
  }

  /// Of drawings and pages the whole files but for what names them and their command.
  void expect_equal(const std::string& made, const std::string& other, const std::string& options,
                    bool choices = true) {
    if (lower_extension(made) == ".html") {
      EXPECT_TRUE(bytes_of(made) == bytes_of(other)) << options;
      return;
    }
    EXPECT_EQ(said_in(made, choices), said_in(other, choices)) << options;
    if (lower_extension(made) == ".exr") {
      const ExrPicture a = read_exr(made), b = read_exr(other);
      EXPECT_TRUE(a.values == b.values && a.channels == b.channels) << options;
    } else {
      EXPECT_TRUE(read_display_image(made, {}).rgb == read_display_image(other, {}).rgb) << options;
    }
  }

  static std::string choices_text_of(const std::vector<api::Choice>& choices) {
    std::string text;
    for (const auto& [field, value] : choices)
      text += (text.empty() ? "--" : " --") + field + (value == "on" ? "" : " " + value);
    return text.empty() ? "none" : text;
  }

  [[nodiscard]] static std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  [[nodiscard]] std::string text_of_file(const std::string& name) const { return bytes_of(file(name)); }
};

TEST_F(Doors, MakeOnePictureOfARequest) {
  const std::string small = "--resolution=24x16 --samples=4 ";
  expect_same("room.pcd", small, ".png");  // view, colours, look, exposure and noise are chosen
  expect_same("room.pcd", small + "--keep-noise --view=dollhouse", ".png");
  expect_same("room.pcd", small + "--aov=depth,normal", ".exr");
  expect_same("room.pcd", small + "--keep-box=-1,-1,-2,1,1,2 --look=ao", ".png");
  expect_same("cube.obj", small + "--mesh-points=2000", ".png");
  expect_same("cube.obj", small + "--mesh-points=2000 --material=glass --environment=sky:30,120", ".png");
  expect_same("cube.obj", small + "--mesh-points=2000 --eye=0.5,0.5,0.9 --target=0.5,0.5,0",
              ".png");  // a room
  expect_same("cube.obj",
              small + "--mesh-points=2000 --eye=0.5,0.5,0.9 --target=0.5,0.5,0 --environment=white", ".exr");
  expect_same("cube.obj", small + "--mesh-points=2000 --area-light=0,3,3,0,0,0,1,1 --look=paper", ".png");
  expect_same("cube.obj", small + "--mesh-points=2000 --area-light=0,3,3,0,0,0,1,1", ".png");
  expect_same("cube.obj", small + "--mesh-points=2000 --light=spot:at=0.5,3,0.5,to=0.5,0,0.5,cone=12,range=9",
              ".png");
  expect_same("brass.gltf", small + "--mesh-points=500", ".exr");
  expect_same("lamp.gltf", small + "--mesh-points=500", ".png");
  expect_same("cube.obj", small + "--mesh-points=2000 --sun-at=2026-06-21T15:00+02:00,48.1,11.6", ".png");
  expect_same("grid.ply", small + "--despeckle --exposure=auto", ".png");
}

TEST_F(Doors, MakeOneDrawingOfARequest) {
  expect_same("room.pcd", "--samples=4 --sheet=plan:z=0.5,scale=100,dpi=40", ".png");
  expect_same("room.pcd", "--samples=2 --sheet=section:-1,0,1,0,scale=100,dpi=40 --ink", ".exr");
  expect_same("room.pcd", "--resolution=21x15 --samples=2 --orbit=3", ".html");
}

TEST(RequestDoor, AWrongNameHasTheNearestOne) {
  for (const auto& [wrong, right] :
       {std::pair("sample", "samples"), {"color_byy", "color-by"}, {"size", "resolution"}}) {
    try {
      (void)api::Request().set(wrong, 4);
      FAIL() << wrong;
    } catch (const api::Error& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("did you mean ") + right + "?"), std::string::npos)
          << error.what();
    }
  }
}

TEST_F(Doors, InputsAreNotReplaced) {
  const api::Scene scene = api::open(std::filesystem::path(file("grid.ply")));
  write("grid.png", "");
  std::filesystem::remove(file("grid.png"));
  std::filesystem::create_hard_link(file("grid.ply"), file("grid.png"));
  EXPECT_THROW((void)api::make(scene, {{"output", file("grid.png")}, {"resolution", "8x8"}}), api::Error);
  EXPECT_THROW(scene.save(file("grid.ply")), api::Error);
  EXPECT_GT(bytes_of(file("grid.ply")).size(), 100U);
}

/// The viewer, without its window.
class ViewerDoor : public Doors {
 protected:
  using Change = std::function<void(Document&, Request& save)>;

  /// The file that it saves of a scene opened with options, once `change` has changed what is shown and what is saved.
  std::string saved(const std::string& scene, const std::string& options, const Change& change = {},
                    const std::string& extension = ".png") {
    Request asked = parse_command_line("splatray-render x --device=cpu " + options);
    asked.output.path = file("saved" + std::to_string(++saves) + extension);
    asked.source.inputs = {file(scene)};
    Request loading = asked;  // as the viewer loads: the document has materials and colours
    loading.look.objects.clear();
    loading.look.attributes = {};
    loading.look.attributes.color_by = "rgb";
    LoadedScene loaded = load_scene(loading, {});
    const SharedScene shared = std::make_shared<const Scene>(std::move(loaded.scene));
    Shot first = resolve(asked, *shared, loaded.facts);
    Document document = first_document(*shared, loaded.facts, asked, first);
    LiveScene live(*device);
    live.open(shared, document.request.look.attributes);
    live.match(document, ViewMode::shaded);
    expose(first, live.shown(), document.loaded->facts);
    choices = choices_text(first);
    Request save = asked;
    if (change) change(document, save);
    if (!asked.look.lights)
      if (const auto light = live.light_at_camera(document, {asked.view.width, asked.view.height}))
        show_light_at_camera(*light, document);
    if (document.loaded->exposes)
      document.request.look.exposure_ev = live.exposure_ev(document, {asked.view.width, asked.view.height});
    const SaveJob job = save_job(document, save);
    command = command_line(job.request);
    (void)save_pictures(job, live, [](const Work&) { return true; });
    return save.output.path.string();
  }

  const std::unique_ptr<Device> device = open_device(HOST_DEVICE);
  int saves = 0;
  std::string choices;  ///< what was chosen when the scene of the file saved last was opened
  std::string command;  ///< of splatray-render, for that file
};

/// Its document of a request is saved as the program's picture, though all that was chosen is said by then.
TEST_F(ViewerDoor, SavesTheProgramsPicture) {
  const std::string small = "--resolution=24x16 --samples=4 ";
  const std::string mesh = small + "--mesh-points=2000 ";
  struct Saved {
    std::string scene, options, extension = ".png";
  };
  for (const auto& [scene, options, extension] : std::vector<Saved>{
           {"room.pcd", small},
           {"room.pcd", small + "--aov=depth,normal", ".exr"},
           {"room.pcd", small + "--keep-box=-1,-1,-2,1,1,2 --look=ao"},
           {"room.pcd", small + "--view=inside --color-by=height", ".exr"},
           {"cube.obj", mesh, ".exr"},
           {"cube.obj", mesh + "--material=glass --environment=sky:30,120"},
           {"brass.gltf", small + "--mesh-points=500"},
           {"lamp.gltf", small + "--mesh-points=500"},
           {"cube.obj", mesh + "--sun-at=2026-06-21T15:00+02:00,48.1,11.6"},
           {"room.pcd", small + "--keep-noise --view=dollhouse"},
           {"cube.obj", mesh + "--eye=0.5,0.5,0.9 --target=0.5,0.5,0"},
           {"cube.obj", mesh + "--eye=0.5,0.5,0.9 --target=0.5,0.5,0 --environment=white", ".exr"},
           {"cube.obj", small + "--mesh-points=2000"},
           {"cube.obj", small + "--mesh-points=2000 --light=spot:at=0.5,3,0.5,to=0.5,0,0.5,cone=12,range=9"},
           {"cube.obj", small + "--mesh-points=2000 --area-light=0,3,3,0,0,0,1,1"},
           {"cube.obj", small + "--mesh-points=2000 --area-light=0,3,3,0,0,0,1,1 --look=paper"}}) {
    const std::string made = by_program(scene, options, "program" + extension);
    const std::string other = saved(scene, options, {}, extension);
    expect_equal(made, other, scene + " " + options, /*choices=*/false);
    EXPECT_EQ(said_in(made)["choices"], choices.empty() ? "none" : choices) << scene << " " << options;
  }
  // An area light stays one when the paper's look, which has none, is left.
  const std::string lamp = small + "--mesh-points=2000 --area-light=0,3,3,0,0,0,1,1 --look=";
  const std::string lit = saved("cube.obj", lamp + "paper",
                                [](Document& document, Request&) { document.request.look.style = LOOK_LIT; });
  const std::string made = by_program("cube.obj", lamp + "lit --tone=soft", "program.png");
  EXPECT_TRUE(read_display_image(made, {}).rgb == read_display_image(lit, {}).rgb);
}

/// A drawing of the section shown: the program's of the same request, pixel for pixel.
TEST_F(ViewerDoor, DrawsTheProgramsSheet) {
  struct Shown {
    SheetKind kind;
    AxisView view;
    std::function<void(Document&)> change;
    const char* extension = ".png";
  };
  const auto slice = [](int axis) {
    return
        [axis](Document& document) { set_slice(document.request.view.region, first_slice(document, axis)); };
  };
  const auto along_x = [](Document& document) { set_up_axis(document, {1.0, 0.0, 0.0}); };
  const auto box = [](Document& document) {
    document.request.view.region.keep_box = TurnedBox{{-1, -1, -2}, {1, 3, 1}, 20};
  };
  for (const Shown& shown :
       {Shown{SheetKind::plan, AxisView::top, slice(1)}, Shown{SheetKind::plan, AxisView::top, {}},
        Shown{SheetKind::plan, AxisView::top, box, ".exr"}, Shown{SheetKind::plan, AxisView::top, along_x},
        Shown{SheetKind::section, AxisView::front, slice(2)},
        Shown{SheetKind::section, AxisView::left, slice(0), ".exr"},
        Shown{SheetKind::section, AxisView::front, box},
        Shown{SheetKind::elevation, AxisView::right, slice(1)},
        Shown{SheetKind::ortho, AxisView::bottom, {}}}) {
    const std::string drawn = saved("room.pcd", "--samples=2", [&](Document& document, Request& save) {
      if (shown.change) shown.change(document);
      set_axis_view(document, shown.view);
      SheetRequest like;
      like.scale = 100.0;
      like.dpi = 25.0;
      save.view.sheet = section_sheet(document, like);
      save.view.ink = shown.kind == SheetKind::section;
      save.output.path.replace_extension(shown.extension);
      EXPECT_EQ(save.view.sheet->kind, shown.kind);
      const bool turned = document.request.look.up != document.loaded->first.look.up;
      EXPECT_EQ(saved_request(document, save).look.lights.has_value(), turned)
          << "the light is over the shoulder of who looks at the sheet";
    });
    std::vector<std::string> words = shell_words(command);
    words.front() = RENDER;
    const std::string made = file(std::string("drawn") + shown.extension);
    words.insert(words.end(), {"--quiet", "--device=cpu", "-o", made});
    const ChildResult result = run_program(words);
    ASSERT_EQ(result.code, 0) << command << ": " << result.err;
    expect_equal(made, drawn, command);
    EXPECT_GT(std::filesystem::file_size(made + ".sheet.json"), 0U);
    EXPECT_TRUE(bytes_of(made + ".sheet.json").size() == bytes_of(drawn + ".sheet.json").size()) << command;
  }
}

/// Pictures of before did not keep what was chosen, and none of a named look went through a denoiser.
TEST_F(Doors, PicturesOfBeforeAreMadeAgainAsTheyWere) {
  const std::string noisy =
      by_program("cube.obj", "--mesh-points=2000 --resolution=24x16 --samples=2 --keep-noise", "a.png");
  Metadata kept;
  for (const auto& [name, value] : read_metadata(noisy)) {
    std::string text = value;
    if (const std::size_t at = text.find(" --keep-noise"); at != std::string::npos) text.erase(at, 13);
    if (name != "choices") kept.emplace_back(name, text);
  }
  write_png(read_display_image(noisy, {}), kept, file("old.png"));
  ASSERT_EQ(run_program({RENDER, "--quiet", "--from", file("old.png"), "-o", file("again.png")}).code, 0);
  EXPECT_TRUE(read_display_image(file("again.png"), {}).rgb == read_display_image(noisy, {}).rgb);
}

}  // namespace
}  // namespace splatray
