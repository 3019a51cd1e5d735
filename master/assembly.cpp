#include "master/assembly.h"

#include <algorithm>

#include "common/base/error.h"

namespace ninefold {
namespace {

// Pixels of a task that has some; tasks without pixels are never sent.
int tasksWithPixels(const TileGrid& grid) {
  int count = 0;
  for (int tile = 0; tile < grid.tiles(); ++tile)
    for (int phase = 0; phase < grid.interleave().sets(); ++phase)
      count += grid.rect(tile, phase).count() > 0 ? 1 : 0;
  return count;
}

constexpr size_t kCopies = 2;  // of a task: the first and one for a straggler

}  // namespace

Assembly::Assembly(const TileGrid& grid, uint8_t layerMask, uint8_t extraMask, int decoders,
                   Answer answer)
    : grid_(grid),
      layerMask_(layerMask),
      extraMask_(extraMask),
      answer_(std::move(answer)),
      queue_(kBuffers * kCopies * static_cast<size_t>(grid.tasks())) {
  for (size_t i = 0; i < kBuffers; ++i)
    slots_.push_back(std::make_unique<Slot>(FrameBuffer(grid, layerMask, extraMask)));
  for (int i = 0; i < decoders; ++i) decoders_.emplace_back([this] { run(); });
}

Assembly::~Assembly() {
  queue_.removeIf([](const ReceivedTile&) { return true; });
  queue_.close();
  for (std::thread& thread : decoders_) thread.join();
}

bool Assembly::hasRoom() const {
  const std::lock_guard lock(mutex_);
  return !std::ranges::all_of(slots_, &Slot::used);
}

void Assembly::open(const FrameKey& frame) {
  const std::lock_guard lock(mutex_);
  const auto slot = std::ranges::find(slots_, false, [](const auto& s) { return s->used; });
  NINEFOLD_CHECK(slot != slots_.end());
  (*slot)->used = true;
  (*slot)->key = frame;
  (*slot)->claimed.assign(static_cast<size_t>(grid_.tasks()), false);
  (*slot)->left = tasksWithPixels(grid_);
}

bool Assembly::take(ReceivedTile& tile) { return queue_.tryPush(tile); }

void Assembly::run() {
  TileDecoder decoder;
  TileResult scratch;
  while (std::optional<ReceivedTile> tile = queue_.pop()) {
    const Time start = Clock::now();
    std::optional<std::string> malformed;
    try {
      decode(*tile, decoder, scratch);
    } catch (const Error& error) {
      malformed = error.what();
    }
    tile->result.encoded = {};
    answer_(std::move(*tile), malformed);
    const std::lock_guard lock(mutex_);
    busy_ += Clock::now() - start;
  }
}

void Assembly::decode(const ReceivedTile& tile, TileDecoder& decoder, TileResult& scratch) {
  const msg::Result& result = tile.result;
  if (!isWanted(result)) return;
  const int index = static_cast<int>(result.tile), phase = static_cast<int>(result.phase);
  const TaskRect rect = grid_.rect(index, phase);
  decoder.decode(result.encoded, {rect.width, rect.height, layerMask_, extraMask_}, scratch);
  // Claimed only now: a malformed copy must not keep a good one out.
  Slot* slot = claim(result);
  if (slot == nullptr) return;
  slot->buffer.place(index, phase, scratch);
  placed(*slot);
}

size_t Assembly::taskIndex(const msg::Result& result) const {
  return static_cast<size_t>(result.tile) * static_cast<size_t>(grid_.interleave().sets()) +
         static_cast<size_t>(result.phase);
}

Assembly::Slot* Assembly::find(uint32_t frame) {
  for (const auto& slot : slots_)
    if (slot->used && slot->key.frame == frame) return slot.get();
  return nullptr;
}

bool Assembly::isWanted(const msg::Result& result) {
  const std::lock_guard lock(mutex_);
  const Slot* slot = find(result.frame);
  return slot != nullptr && !slot->claimed.at(taskIndex(result));
}

Assembly::Slot* Assembly::claim(const msg::Result& result) {
  const std::lock_guard lock(mutex_);
  Slot* slot = find(result.frame);
  if (slot == nullptr || slot->claimed[taskIndex(result)]) return nullptr;
  slot->claimed[taskIndex(result)] = true;
  return slot;
}

void Assembly::placed(Slot& slot) {
  const std::lock_guard lock(mutex_);
  if (--slot.left > 0) return;
  slot.completed = Clock::now();
  complete_.notify_all();
}

std::optional<Assembly::Complete> Assembly::next(Time deadline) {
  std::unique_lock lock(mutex_);
  const auto ready = [this] {
    const Slot* slot = find(nextFrame_);
    return slot != nullptr && slot->left == 0;
  };
  if (!complete_.wait_until(lock, deadline, ready)) return std::nullopt;
  const Slot* slot = find(nextFrame_++);
  return Complete{slot->key, &slot->buffer, slot->completed};
}

void Assembly::release(const Complete& frame) {
  const std::lock_guard lock(mutex_);
  find(frame.key.frame)->used = false;
}

Duration Assembly::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_;
}

}  // namespace ninefold
