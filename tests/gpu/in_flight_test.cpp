// Dispatches that are handed over before the one before is waited for.
#include <functional>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "engine/gpu/runner.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

/// Hands all on to another queue, and writes down in which order work was begun (b), ended (e) and run (r).
class WatchedQueue final : public Queue {
 public:
  WatchedQueue(std::unique_ptr<Queue> inner, std::string& log) : inner_(std::move(inner)), log_(log) {}

  [[nodiscard]] bool fuses() const override { return inner_->fuses(); }
  [[nodiscard]] std::unique_ptr<Buffer> make_buffer(std::uint64_t bytes) override {
    return inner_->make_buffer(bytes);
  }
  [[nodiscard]] std::unique_ptr<DeviceTexture> make_texture(const Environment& environment) override {
    return inner_->make_texture(environment);
  }
  [[nodiscard]] std::unique_ptr<Bindings> make_bindings(const Paging& paging) override {
    return inner_->make_bindings(paging);
  }
  void upload(Buffer& buffer, std::span<const std::byte> bytes, std::uint64_t begin) override {
    inner_->upload(buffer, bytes, begin);
  }
  void download(const Buffer& buffer, std::span<std::byte> bytes) override {
    inner_->download(buffer, bytes);
  }
  Ran run(const Dispatch& dispatch, const Bindings& bindings) override {
    log_ += 'r';
    return inner_->run(dispatch, bindings);
  }
  void begin(const Dispatch& dispatch, const Bindings& bindings) override {
    log_ += 'b';
    inner_->begin(dispatch, bindings);
  }
  Ran end() override {
    log_ += 'e';
    return inner_->end();
  }
  void finish() override { inner_->finish(); }
  [[nodiscard]] std::uint32_t programs_built() const override { return inner_->programs_built(); }

 private:
  std::unique_ptr<Queue> inner_;
  std::string& log_;
};

/// A device whose queues are watched, which is given two dispatches at once.
class WatchedDevice final : public Device {
 public:
  explicit WatchedDevice(const Device& inner) : inner_(inner) {}

  [[nodiscard]] const DeviceInfo& info() const override { return inner_.info(); }
  [[nodiscard]] const DeviceLimits& limits() const override { return inner_.limits(); }
  [[nodiscard]] DeviceProfile profile() const override {
    DeviceProfile profile = inner_.profile();
    profile.samples_most = profile.paths_most = 1;
    profile.in_flight = 2;
    return profile;
  }
  [[nodiscard]] std::unique_ptr<Queue> make_queue(const QueueOptions& options) const override {
    return std::make_unique<WatchedQueue>(inner_.make_queue(options), log);
  }

  mutable std::string log;

 private:
  const Device& inner_;
};

class InFlightTest : public DeviceTest {
 protected:
  void SetUp() override {
    settings.samples = 4;
    one.upload(scene);
    two.upload(scene);
    watched.log.clear();
  }

  const Scene scene = disc_scene();
  const View view = disc_view(20, 20);
  Settings settings = plain_settings();
  WatchedDevice watched{device};
  ShownTracer one{device, {.in_flight = 1}};
  ShownTracer two{watched};
};

TEST_F(InFlightTest, TheNextIsBegunBeforeTheLastIsWaitedFor) {
  EXPECT_TRUE(one.render(view, settings).rgba == two.render(view, settings).rgba);
  EXPECT_EQ(watched.log, "bbebebee");
  EXPECT_GT(two.stats().trace_ms, 0.0);
}

TEST_F(InFlightTest, WhatCountsIsWaitedFor) {
  settings.counters = true;
  EXPECT_TRUE(one.render(view, settings).rgba == two.render(view, settings).rgba);
  EXPECT_EQ(watched.log, "rrrr");
  EXPECT_EQ(one.stats().counters, two.stats().counters);
}

TEST_F(InFlightTest, ProgressIsToldOfWhatIsDone) {
  std::string seen;
  (void)two.render(view, settings, [&](double share) {
    seen += std::to_string(static_cast<int>(share * 4.0 + 0.5)) + watched.log + " ";
    return true;
  });
  EXPECT_EQ(seen, "1bbe 2bbebe 3bbebebe 4bbebebee ");
}

TEST_F(InFlightTest, APictureThatIsStoppedLeavesNothingBehind) {
  EXPECT_THROW((void)two.render(view, settings, [](double) { return false; }), Error);
  EXPECT_EQ(watched.log, "bbee") << "both were waited for";
  EXPECT_TRUE(one.render(view, settings).rgba == two.render(view, settings).rgba);
}

TEST_F(InFlightTest, APictureThatGrowsIsTheSame) {
  const auto grown = [&](ShownTracer& tracer) {
    tracer.begin(view, settings);
    while (!tracer.advance(10.0)) {
    }
    return tracer.picture().rgba;
  };
  EXPECT_TRUE(grown(one) == grown(two));
  EXPECT_EQ(watched.log.substr(0, 4), "bbeb");
  EXPECT_GT(two.stats().trace_ms, 0.0);
}

/// The device may be at a sample when anything else is asked of it.
TEST_F(InFlightTest, WhatElseIsAskedMeanwhileWaits) {
  const std::vector<std::function<void(ShownTracer&)>> others = {
      [this](ShownTracer& tracer) { (void)tracer.render(view, settings); },
      [this](ShownTracer& tracer) { (void)tracer.trace_aov(disc_view(30, 9), settings); },
      [this](ShownTracer& tracer) { (void)tracer.intersect(std::vector<RayQuery>(5), settings); },
      [](ShownTracer& tracer) { (void)tracer.picture(); },
      [](ShownTracer& tracer) { (void)tracer.grown(); },
      [this](ShownTracer& tracer) {
        tracer.look.lights = {};
        (void)tracer.render(view, settings);
      }};
  const std::vector<vec4> alone = one.render(view, settings).rgba;
  for (std::size_t i = 0; i < others.size(); ++i) {
    two.begin(view, settings);
    two.advance(INFINITY);
    others[i](two);
    while (!two.advance(INFINITY)) {
    }
    EXPECT_TRUE(two.picture().rgba == alone) << "after " << i;
  }
}

TEST_F(InFlightTest, OtherBuffersWait) {
  Runner runner(device, {.in_flight = 2});
  runner.scene.upload(scene);
  runner.scene.show(look_of(scene));
  runner.queue->reserve(runner.accumulation, 64 * sizeof(vec4));
  runner.bind(*runner.accumulation);
  TileDispatch tile = aim(runner.picture_dispatch(disc_view(8, 8), settings), {0, 0, 8, 8});
  runner.begin_samples(tile, 0, 1, {});
  const std::unique_ptr<Buffer> other = runner.queue->make_buffer(64 * sizeof(vec4));
  runner.bind(*other);
  runner.begin_samples(tile, 0, 1, {});
  std::vector<vec4> means(64), others(64);
  runner.queue->download(*runner.accumulation, std::as_writable_bytes(std::span(means)));
  runner.queue->download(*other, std::as_writable_bytes(std::span(others)));
  EXPECT_TRUE(means == others);
  EXPECT_GT(means[27].w, 0.0F);
  runner.finish();
}

TEST_F(InFlightTest, AnotherSceneAndTheEndWait) {
  ShownTracer tracer(watched);
  tracer.upload(scene);
  tracer.begin(view, settings);
  tracer.advance(INFINITY);
  tracer.upload(disc_scene(3));
  tracer.begin(view, settings);
  tracer.advance(INFINITY);
}

}  // namespace
}  // namespace splatray
