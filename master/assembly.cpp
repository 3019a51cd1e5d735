#include "master/assembly.h"

#include <algorithm>

#include "common/base/cpu_time.h"
#include "common/base/error.h"
#include "common/sampling/whole_tile.h"

namespace ninefold {
namespace {

constexpr size_t kCopies = 2;  // of a task: the first and one for a straggler

int tileOf(const msg::Result& result) { return static_cast<int>(result.tile); }
int phaseOf(const msg::Result& result) { return static_cast<int>(result.phase); }

// Do pixels of both have the same planes?
bool isLike(const FrameShape& a, const std::optional<FrameShape>& b) {
  return b && a.layerMask == b->layerMask && a.extraMask == b->extraMask;
}

double pixelsOf(const GatheredFrame& frame) {
  const TileGrid& grid = frame.view.shape.grid;
  return static_cast<double>(grid.width()) * grid.height();
}

}  // namespace

Assembly::Assembly(int workers, Answer answer, Finish finish)
    : answer_(std::move(answer)), finish_(std::move(finish)) {
  for (int i = 0; i < workers; ++i) workers_.emplace_back([this, i] { run(i); });
}

Assembly::~Assembly() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  work_.notify_all();
  for (std::thread& thread : workers_) thread.join();
}

bool Assembly::hasRoom() const {
  const std::lock_guard lock(mutex_);
  const int open = books_.openFrames();
  if (open == 0) return true;
  if (open >= kMostFrames || bytes_ >= kMostBytes) return false;
  if (open < kLeastFrames) return true;
  const GatheredFrame& newest = slots_.rbegin()->second->frame;
  if (!isLike(newest.view.shape, measured_)) return false;  // who knows how much comes
  const double another = bytesPerPixel_ * pixelsOf(newest);
  return (open + 1) * another <= double{kMostBytes};
}

void Assembly::open(const FrameView& view) {
  auto slot = std::make_unique<Slot>();
  const auto tasks = static_cast<size_t>(view.shape.grid.tasks());
  slot->frame.view = view;
  slot->frame.tasks.resize(tasks);
  const std::lock_guard lock(mutex_);
  books_.open(view.key.frame, view.shape.grid, isFiltered(view.shape));
  slots_.emplace(view.key.frame, std::move(slot));
  queueLimit_ = std::max(queueLimit_, kMostFrames * kCopies * tasks);
}

bool Assembly::take(ReceivedTile& tile) {
  {
    const std::lock_guard lock(mutex_);
    if (queue_.size() >= queueLimit_) return false;
    bytes_ += tile.result.encoded.size();
    queue_.push_back(std::move(tile));
  }
  work_.notify_one();
  return true;
}

// --- workers ---

void Assembly::run(int worker) {
  TileDecoder decoder;
  std::unique_lock lock(mutex_);
  while (true) {
    work_.wait(lock, [this] { return closing_ || books_.hasTile() || !queue_.empty(); });
    if (closing_) return;
    if (books_.hasTile()) {  // first: it frees memory, and somebody waits for the frame
      finishOne(lock, worker);
      continue;
    }
    ReceivedTile tile = std::move(queue_.front());
    queue_.pop_front();
    bytes_ -= tile.result.encoded.size();
    lock.unlock();
    const Duration start = threadCpuTime();
    unpack(std::move(tile), decoder);
    const Duration spent = threadCpuTime() - start;
    lock.lock();
    busy_.unpacking += spent;
  }
}

void Assembly::unpack(ReceivedTile&& tile, TileDecoder& decoder) {
  msg::Result& result = tile.result;
  std::optional<std::string> malformed;
  try {
    if (const auto shape = shapeIfWanted(result)) {
      // Placed only now: a malformed copy must not keep a good one out.
      place(result, decoder.unpack(std::move(result.encoded), *shape), tile.arrived);
    }
  } catch (const Error& error) {
    malformed = error.what();
  }
  result.encoded = {};
  answer_(std::move(tile), malformed);
}

std::optional<TileShape> Assembly::shapeIfWanted(const msg::Result& result) {
  const std::lock_guard lock(mutex_);
  if (!books_.isWanted(result.frame, tileOf(result), phaseOf(result))) return std::nullopt;
  const FrameShape& frame = slots_.at(result.frame)->frame.view.shape;
  const TaskRect rect = isFiltered(frame) ? pixelsOf(frame.grid, tileOf(result))
                                          : frame.grid.rect(tileOf(result), phaseOf(result));
  return TileShape{rect.width, rect.height, frame.layerMask, frame.extraMask};
}

void Assembly::place(const msg::Result& result, UnpackedTile&& unpacked, Time arrived) {
  const std::lock_guard lock(mutex_);
  const int tile = tileOf(result), phase = phaseOf(result);
  if (!books_.isWanted(result.frame, tile, phase)) return;
  Slot& slot = *slots_.at(result.frame);
  const int sets = slot.frame.view.shape.grid.interleave().sets();
  bytes_ += unpacked.bytes(), slot.bytes += unpacked.bytes();
  slot.frame.tasks[static_cast<size_t>(tile * sets + phase)] = std::move(unpacked);
  slot.lastResult = std::max(slot.lastResult, arrived);
  books_.place(result.frame, tile, phase);
  if (books_.hasTile()) work_.notify_all();
}

void Assembly::finishOne(std::unique_lock<std::mutex>& lock, int worker) {
  const uint32_t number = *books_.front();
  const int tile = *books_.nextTile();
  Slot& slot = *slots_.at(number);
  ++finishing_;
  lock.unlock();
  const Duration start = threadCpuTime();
  finish_(worker, slot.frame, tile);
  const Duration spent = threadCpuTime() - start;
  lock.lock();
  busy_.finishing += spent;
  const int sets = slot.frame.view.shape.grid.interleave().sets();
  for (const int unused : books_.tileDone(number, tile))
    for (int phase = 0; phase < sets; ++phase) {
      UnpackedTile& task = slot.frame.tasks[static_cast<size_t>(unused * sets + phase)];
      bytes_ -= task.bytes();
      task = {};
    }
  if (--finishing_ == 0) idle_.notify_all();
  if (!books_.isDone(number)) return;
  slot.finished = Clock::now();
  measured_ = slot.frame.view.shape;
  bytesPerPixel_ = static_cast<double>(slot.bytes) / pixelsOf(slot.frame);
  complete_.notify_all();
}

// --- the film's thread ---

std::optional<Assembly::Complete> Assembly::next(Time deadline) {
  std::unique_lock lock(mutex_);
  const auto isReady = [this] {
    const auto front = books_.front();
    return front && books_.isDone(*front);
  };
  if (!complete_.wait_until(lock, deadline, isReady)) return std::nullopt;
  held_ = books_.front();
  const Slot& slot = *slots_.at(*held_);
  return Complete{slot.frame.view.key, slot.lastResult, slot.finished};
}

void Assembly::release(const Complete& frame) {
  const std::lock_guard lock(mutex_);
  held_.reset();
  closeFrame(frame.key.frame);
}

void Assembly::closeFrame(uint32_t number) {
  for (const UnpackedTile& task : slots_.at(number)->frame.tasks) bytes_ -= task.bytes();
  books_.close(number);
  slots_.erase(number);
  if (books_.hasTile()) work_.notify_all();  // of the frame behind it
}

void Assembly::supersede(uint32_t firstWanted) {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [this] { return finishing_ == 0; });
  for (auto slot = slots_.begin(); slot != slots_.end() && slot->first < firstWanted;) {
    const uint32_t number = slot++->first;
    if (number != held_) closeFrame(number);
  }
}

Assembly::Busy Assembly::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_;
}

}  // namespace ninefold
