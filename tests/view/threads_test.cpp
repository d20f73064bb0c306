// The threads beside the window's: what they are asked for comes back, whatever goes wrong in between.
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>

#include "app/library/image_file.h"
#include "app/library/request/command_line.h"
#include "app/library/shot/scene_source.h"
#include "app/view/model/document_request.h"
#include "app/view/thread/load_thread.h"
#include "app/view/thread/render_thread.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "tests/cli/child_process.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/view/live_documents.h"

namespace splatray {
namespace {

constexpr glm::uvec2 SHOWN_SIZE{67, 43};
constexpr std::chrono::seconds PATIENCE{60};

/// Wakes a test as the window is woken.
class Alarm {
 public:
  std::function<void()> bell() {
    return [this] {
      const std::lock_guard lock(mutex_);
      ++rung_;
      changed_.notify_one();
    };
  }
  /// Whether `enough`, asked after each ring, said so in time.
  bool until(const std::function<bool()>& enough) {
    std::unique_lock lock(mutex_);
    const auto end = std::chrono::steady_clock::now() + PATIENCE;
    while (true) {
      const int heard = rung_;
      lock.unlock();
      if (enough()) return true;
      lock.lock();
      if (!changed_.wait_until(lock, end, [&] { return rung_ != heard; })) return false;
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int rung_ = 0;
};

class RenderThreadTest : public CliTest {
 protected:
  void TearDown() override {
    EXPECT_EQ(opened->validation_messages(), 0U);
    CliTest::TearDown();
  }

  /// Waits for news that `wanted` takes.
  void await(const std::function<bool(const RenderNews&)>& wanted) {
    EXPECT_TRUE(alarm.until([&] { return wanted(thread.poll()); }));
  }

  SharedScene scene = shared_discs();
  Document document = disc_document(*scene);
  Alarm alarm;
  std::unique_ptr<Device> opened = open_device("");
  RenderThread thread{*opened, nullptr, alarm.bell()};
};

TEST_F(RenderThreadTest, FinishesThePicture) {
  thread.open(scene, document, SHOWN_SIZE);
  await([&](const RenderNews& news) {
    return news.frame && news.frame->samples == document.request.settings.samples;
  });
}

/// And nothing of what it was not asked to find.
TEST_F(RenderThreadTest, FindsTheLightThatAClosedRoomNeeds) {
  write("cube.obj", cube_obj());
  Request asked =
      parse_command_line("splatray-render x --mesh-points=2000 --eye=0.5,0.5,0.9 --target=0.5,0.5,0");
  asked.source.inputs = {file("cube.obj")};
  LoadedScene loaded = load_scene(asked, {});
  const SharedScene room = std::make_shared<const Scene>(std::move(loaded.scene));
  const Document within = first_document(*room, loaded.facts, asked);
  thread.open(room, within, SHOWN_SIZE, {.light_at_camera = true});
  await([&](const RenderNews& news) {
    EXPECT_FALSE(news.exposure_ev);
    if (!news.light_at_camera) return false;
    EXPECT_EQ(news.light_at_camera->position, within.camera.eye);
    return true;
  });
}

TEST_F(RenderThreadTest, AnswersWhatIsUnderTheCursor) {
  thread.open(scene, document, SHOWN_SIZE);
  thread.pick({glm::dvec2(SHOWN_SIZE) * 0.5, SHOWN_SIZE, PickFor::pivot});
  await([](const RenderNews& news) {
    if (!news.pick) return false;
    EXPECT_EQ(news.pick->purpose, PickFor::pivot);
    EXPECT_NEAR(glm::length(news.pick->inspected.value().hit_world), 0.0, 1e-6);
    return true;
  });
  thread.pick({{0.5, 0.5}, SHOWN_SIZE});
  await([](const RenderNews& news) { return news.pick && !news.pick->inspected; });
}

TEST_F(RenderThreadTest, SavesWhatTheHeadlessTracerMakes) {
  thread.open(scene, document, SHOWN_SIZE);
  Request request;
  request.output.path = file("out.exr");
  request.view.width = 31;
  request.view.height = 17;
  request.settings.samples = 5;
  thread.save(save_job(document, request));
  await([](const RenderNews& news) { return !news.notice.empty(); });
  VulkanDevice device;
  ShownTracer tracer(device);
  tracer.upload(*scene);
  tracer.set_environment({0, 0, {}, vec3(1.0F)});
  document.request.settings.samples = 5;
  const Image image = tracer.render({document.camera, 31, 17}, document.request.settings);
  EXPECT_TRUE(display_image(image, 0.0).rgb == read_display_image(request.output.path, 0.0).rgb);
}

TEST_F(RenderThreadTest, RecordsATurntable) {
  thread.open(scene, document, SHOWN_SIZE);
  Request request;
  request.output.path = file("turn.##.png");
  request.output.turntable = 3;
  request.view.width = request.view.height = 16;
  request.settings.samples = 1;
  thread.save(save_job(document, request));
  await([](const RenderNews& news) { return !news.notice.empty(); });
  EXPECT_EQ(names(), (std::vector<std::string>{"turn.00.png", "turn.01.png", "turn.02.png"}));
}

TEST_F(RenderThreadTest, RecordingAgainMakesWhatIsMissing) {
  thread.open(scene, document, SHOWN_SIZE);
  Request request;
  request.output.path = file("turn.#.png");
  request.output.turntable = 3;
  request.view.width = request.view.height = 16;
  request.settings.samples = 1;
  request.output.skip_existing = true;
  const auto record = [&] {
    std::string notice;
    thread.save(save_job(document, request));
    await([&](const RenderNews& news) { return !(notice = news.notice).empty(); });
    return notice;
  };
  EXPECT_EQ(record().find("were there"), std::string::npos);
  const auto time = std::filesystem::last_write_time(file("turn.0.png"));
  std::filesystem::remove(file("turn.1.png"));
  EXPECT_NE(record().find("1 of 3 pictures"), std::string::npos);
  EXPECT_EQ(std::filesystem::last_write_time(file("turn.0.png")), time) << "a finished picture stays";
  EXPECT_TRUE(std::filesystem::exists(file("turn.1.png")));
  document.camera.eye.x += 0.5;
  EXPECT_NE(record().find(": 3 pictures"), std::string::npos) << "they show something else";
}

TEST_F(RenderThreadTest, FailuresAreSentencesAndItGoesOn) {
  thread.open(scene, document, SHOWN_SIZE);
  Request request;
  request.output.path = file("missing/out.png");
  thread.save(save_job(document, request));
  await([](const RenderNews& news) { return news.error.find("missing") != std::string::npos; });
  await([](const RenderNews& news) { return !news.saving; });
  document.request.look.environment = file("missing.hdr");
  thread.show(document, SHOWN_SIZE);
  await([](const RenderNews& news) { return news.error.find("missing.hdr") != std::string::npos; });
  document.camera.eye.x = document.camera.target.x = 0.1;
  thread.show(document, SHOWN_SIZE);
  await([&](const RenderNews& news) { return news.frame && news.frame->view.camera == document.camera; });
}

TEST_F(RenderThreadTest, ALongSaveIsCancelled) {
  thread.open(scene, document, SHOWN_SIZE);
  Request request;
  request.output.path = file("out.png");
  request.view.width = request.view.height = 2000;
  request.settings.samples = 65536;
  thread.save(save_job(document, request));
  await([](const RenderNews& news) { return news.saving.has_value(); });
  thread.cancel_save();
  await([](const RenderNews& news) { return news.notice == "cancelled"; });
  await([](const RenderNews& news) { return !news.saving; });
  EXPECT_TRUE(names().empty());
}

class LoadThreadTest : public CliTest {
 protected:
  void load(const std::string& path) {
    Request request;
    request.source.inputs = {path};
    thread.load(request);
  }
  void await(const std::function<bool(const LoadNews&)>& wanted) {
    EXPECT_TRUE(alarm.until([&] { return wanted(thread.poll()); }));
  }

  Alarm alarm;
  LoadThread thread{alarm.bell()};
};

TEST_F(LoadThreadTest, OpensWithADocumentThatShowsIt) {
  load(write("grid.ply", grid_ply(true)));
  await([](const LoadNews& news) {
    if (!news.opened) return false;
    EXPECT_EQ(news.opened->scene->data_pool.size(), 144U);
    EXPECT_EQ(news.opened->document.loaded->object_names, std::vector<std::string>{"grid"});
    EXPECT_FALSE(news.opened->document.request.look.lights->empty());
    return true;
  });
}

TEST_F(LoadThreadTest, ReportsWhyAndGoesOn) {
  load(file("missing.ply"));
  await([](const LoadNews& news) {
    return news.error.find("missing.ply") != std::string::npos && !news.progress;
  });
  load(write("grid.ply", grid_ply(true)));
  await([](const LoadNews& news) { return news.opened.has_value(); });
}

TEST_F(LoadThreadTest, TheNewestCountsAndCancelEndsIt) {
  const std::string grid = write("grid.ply", grid_ply(true)), other = write("other.ply", grid_ply(true, 5.0));
  for (int i = 0; i < 10; ++i) load(grid);
  load(other);
  await([](const LoadNews& news) {
    return news.opened && news.opened->document.loaded->object_names[0] == "other";
  });
  load(grid);
  thread.cancel();
  await([](const LoadNews& news) {
    EXPECT_FALSE(news.opened);
    return !news.progress;
  });
}

}  // namespace
}  // namespace splatray
