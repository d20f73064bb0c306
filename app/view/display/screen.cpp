#include "app/view/display/screen.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "app/view/display/eye_dome.h"
#include "engine/base/srgb.h"
#include "engine/device/program.h"
#include "engine/device/vulkan/pipeline.h"
#include "shaders/spirv.h"

namespace splatray {
namespace {

constexpr VkBufferUsageFlags STORAGE = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

VulkanBuffer words(const VulkanDevice& vulkan, std::uint32_t count) {
  return {vulkan, count * sizeof(std::uint32_t), STORAGE};
}

std::shared_ptr<const TimelineSemaphore> make_timeline(const VulkanDevice& vulkan) {
  VkSemaphoreTypeCreateInfo type{};
  type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
  type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
  VkSemaphoreCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
  info.pNext = &type;
  VkSemaphore semaphore = VK_NULL_HANDLE;
  check(vkCreateSemaphore(vulkan.device, &info, nullptr, &semaphore), "making a semaphore");
  return std::make_shared<const TimelineSemaphore>(vulkan.device, semaphore);
}

std::uint32_t tone_number(Tone tone) {
  if (tone == Tone::neutral) return DISPLAY_TONE_NEUTRAL;
  return tone == Tone::agx ? DISPLAY_TONE_AGX : DISPLAY_TONE_TABLE;
}

/// Only what shows a picture has a tone curve.
std::pair<std::uint32_t, std::uint32_t> program_key(std::uint32_t step, std::uint32_t tone) {
  const bool tones = step == DISPLAY_PLAIN || step == DISPLAY_SEEN;
  return {step, tones ? tone : DISPLAY_TONE_TABLE};
}

/// What follows the display's own table in the curves.
std::vector<std::uint32_t> fixed_curves() {
  std::vector<std::uint32_t> fixed(DISPLAY_CURVE_WORDS - DISPLAY_AS_IT_IS);
  const auto as_it_is = std::make_unique<DisplayTable>(Display(0.0, Tone::none));
  std::memcpy(fixed.data(), as_it_is->values().data(), as_it_is->values().size());
  for (std::uint32_t i = 0; i < 256; ++i)
    fixed[DISPLAY_LINEAR - DISPLAY_AS_IT_IS + i] =
        std::bit_cast<std::uint32_t>(srgb_to_linear(static_cast<float>(i) / 255.0F));
  return fixed;
}

DisplayParams params_of(const GrownPicture& grown, const ShownAs& how) {
  const DomeScale dome = dome_scale(how.view, how.eye_dome);
  return {.width = grown.width,
          .height = grown.height,
          .samples = grown.samples,
          .next_row = grown.next_row,
          .samples_before = grown.samples_before,
          .factor = static_cast<float>(std::exp2(how.table.display().exposure_ev)),
          .dome_exponent = dome.exponent,
          .per_world = dome.per_world};
}

NoisyPicture noisy(const GrownPicture& grown) {
  const std::uint32_t all = grown.samples_before + grown.samples;
  return {grown.width, grown.height, static_cast<const VulkanBuffer*>(grown.means),
          static_cast<const VulkanBuffer*>(grown.before),
          static_cast<float>(grown.samples) / static_cast<float>(all)};
}

}  // namespace

Screen::Screen(const VulkanDevice& vulkan)
    : vulkan_(vulkan),
      transfers_(vulkan),
      set_(vulkan, std::array<DescriptorSet::Binding, DISPLAY_BINDINGS>{}),
      pool_(make_command_pool(vulkan)),
      commands_(make_commands(vulkan, pool_.get())),
      params_(vulkan, sizeof(DisplayParams), STORAGE),
      curves_(words(vulkan, DISPLAY_CURVE_WORDS)),
      state_(words(vulkan, DISPLAY_STATE_WORDS)),
      ring_(vulkan, STORAGE, Residence::device),
      made_(make_timeline(vulkan)) {
  set_.write(DISPLAY_BIND_PARAMS, params_.get());
  set_.write(DISPLAY_BIND_CURVES, curves_.get());
  set_.write(DISPLAY_BIND_STATE, state_.get());
  const std::vector<std::uint32_t> fixed = fixed_curves();
  transfers_.upload(curves_, std::as_bytes(std::span(fixed)), DISPLAY_AS_IT_IS * sizeof(std::uint32_t));
  forget();
}

Screen::~Screen() { wait_for_last(); }

VkResult Screen::wait_for_last() const {
  const VkSemaphore semaphore = made_->get();
  VkSemaphoreWaitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
  info.semaphoreCount = 1;
  info.pSemaphores = &semaphore;
  info.pValues = &made_at_;
  return vkWaitSemaphores(vulkan_.device, &info, UINT64_MAX);
}

void Screen::wait() {
  check(wait_for_last(), "waiting for a picture");
  if (filter_) filter_->wait();
}

void Screen::forget() {
  wait();
  std::array<std::uint32_t, DISPLAY_STATE_WORDS> none{};
  none[DISPLAY_GAIN] = std::bit_cast<std::uint32_t>(1.0F);
  transfers_.upload(state_, std::as_bytes(std::span(none)));
  rests_ = false;
}

void Screen::take_curve(const DisplayTable& table) {
  if (curve_ == table.display()) return;
  transfers_.upload(curves_, std::as_bytes(table.values()));
  curve_ = table.display();
}

SharedPicture Screen::show(const Image& image, const ShownAs& how) {
  wait();
  const auto bytes = std::as_bytes(std::span(image.rgba));
  if (means_.get() == VK_NULL_HANDLE || means_.size() < bytes.size())
    means_ = VulkanBuffer(vulkan_, bytes.size(), STORAGE);
  transfers_.upload(means_, bytes);
  return show({image.width, image.height, &means_, &means_, 0, 1, 0}, how);
}

SharedPicture Screen::show(const GrownPicture& grown, const ShownAs& how) {
  wait();
  take_curve(how.table);
  const std::shared_ptr<DevicePicture> picture =
      ring_.take(std::uint64_t{grown.width} * grown.height * sizeof(std::uint32_t));
  set_.write(DISPLAY_BIND_MEANS, static_cast<const VulkanBuffer*>(grown.means)->get());
  set_.write(DISPLAY_BIND_BEFORE, static_cast<const VulkanBuffer*>(grown.before)->get());
  set_.write(DISPLAY_BIND_PIXELS, picture->pixels.get());
  record(params_of(grown, how), how);
  submit();
  picture->made = made_;
  picture->made_at = made_at_;
  return picture;
}

void Screen::keep(const GrownPicture& part) {
  if (!filter_) filter_.emplace(vulkan_);
  filter_->keep(noisy(part));
}

void Screen::filter(const GrownPicture& grown, float part_share, const DeviceGuide& guide) {
  const VulkanBuffer& result = filter_->run(noisy(grown), part_share, *guide.base, *guide.aov);
  filtered_ = {grown.width, grown.height, &result, &result, 0, 1, 0};
}

SharedPicture Screen::show_filtered(const ShownAs& how) { return show(filtered_, how); }

bool Screen::has_cut_loops() {
  if (!vulkan_.is_cpu()) return false;
  wait();
  std::array<std::uint32_t, DISPLAY_STATE_WORDS> state{};
  transfers_.download(state_, std::as_writable_bytes(std::span(state)));
  return state[DISPLAY_CUT] != 0;
}

void Screen::record(const DisplayParams& params, const ShownAs& how) {
  const std::uint32_t pixels = params.width * params.height;
  constexpr VkDeviceSize WORD = sizeof(std::uint32_t), SUM = 3 * WORD;
  begin_commands(commands_);
  record_barrier(commands_);
  vkCmdFillBuffer(commands_, state_.get(), DISPLAY_CUT * WORD, WORD, 0);
  vkCmdUpdateBuffer(commands_, params_.get(), 0, sizeof(params), &params);
  const VkDescriptorSet set = set_.get();
  vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, set_.layout()->get(), 0, 1, &set, 0,
                          nullptr);
  if (!how.is_seen && !how.moving) {
    vkCmdFillBuffer(commands_, state_.get(), DISPLAY_SUM_REST * WORD, SUM, 0);
    record_step(DISPLAY_PLAIN, pixels, how.table);
    record_step(DISPLAY_MEASURE_REST, pixels, how.table);
    rests_ = true;
  } else if (!how.is_seen) {
    record_step(DISPLAY_PLAIN, pixels, how.table);
  } else {
    if (rests_) {
      vkCmdFillBuffer(commands_, state_.get(), DISPLAY_SUM_SEEN * WORD, SUM, 0);
      record_step(DISPLAY_MEASURE_SEEN, pixels, how.table);
      record_step(DISPLAY_MATCH, pixels, how.table);
      rests_ = false;
    }
    record_step(DISPLAY_SEEN, pixels, how.table);
  }
  check(vkEndCommandBuffer(commands_), "recording commands");
}

Screen::Program Screen::build(const ProgramKey& key) const {
  PipelineKey constants;
  constants.constants[DISPLAY_SPEC_STEP] = key.first;
  constants.constants[DISPLAY_SPEC_TONE] = key.second;
  return make_pipeline(vulkan_, constants, DISPLAY, set_.layout()->get(), VK_NULL_HANDLE);
}

void Screen::prepare(Tone tone) {
  if (begun_.valid() || !programs_.empty()) return;
  begun_ = std::async(std::launch::async, [this, number = tone_number(tone)] {
    std::map<ProgramKey, Program> built;
    for (const std::uint32_t step :
         {DISPLAY_SEEN, DISPLAY_PLAIN, DISPLAY_MEASURE_REST, DISPLAY_MEASURE_SEEN, DISPLAY_MATCH}) {
      const ProgramKey key = program_key(step, number);
      built.emplace(key, build(key));
    }
    return built;
  });
}

VkPipeline Screen::program(const ProgramKey& key) {
  if (begun_.valid()) programs_ = begun_.get();
  auto found = programs_.find(key);
  if (found == programs_.end()) found = programs_.emplace(key, build(key)).first;
  return found->second.get();
}

void Screen::record_step(std::uint32_t step, std::uint32_t pixels, const DisplayTable& table) {
  const bool shows = step == DISPLAY_PLAIN || step == DISPLAY_SEEN;
  const std::uint32_t threads = shows ? pixels : groups(pixels, DISPLAY_SUMMED);
  Dispatch dispatch;
  dispatch.set_groups(step == DISPLAY_MATCH ? 1 : groups(threads, GROUP_SIZE));
  record_barrier(commands_);
  vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE,
                    program(program_key(step, tone_number(table.display().tone))));
  vkCmdDispatch(commands_, dispatch.groups_x, dispatch.groups_y, 1);
  record_barrier(commands_);
}

void Screen::submit() {
  const VkSemaphore semaphore = made_->get();
  const std::uint64_t value = made_at_ + 1;
  VkTimelineSemaphoreSubmitInfo timeline{};
  timeline.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO;
  timeline.signalSemaphoreValueCount = 1;
  timeline.pSignalSemaphoreValues = &value;
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.pNext = &timeline;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &commands_;
  info.signalSemaphoreCount = 1;
  info.pSignalSemaphores = &semaphore;
  check(vulkan_.queue->submit(info, VK_NULL_HANDLE), "showing a picture");
  made_at_ = value;
}

}  // namespace splatray
