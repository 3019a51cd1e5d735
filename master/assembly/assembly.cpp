#include "master/assembly/assembly.h"

#include <algorithm>

#include "common/base/cpu_time.h"
#include "common/base/error.h"
#include "common/sampling/whole_tile.h"

namespace ninefold {
namespace {

constexpr size_t kTogether = 8;  // results that a worker unpacks at once
constexpr size_t kCopies = 2;    // of a task: the first and one for a straggler

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

Assembly::~Assembly() { close(); }

void Assembly::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  work_.notify_all();
  for (std::thread& thread : workers_) thread.join();
  workers_.clear();
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
  slot->opened = Clock::now();
  slot->frame.tasks.resize(tasks);
  const std::lock_guard lock(mutex_);
  books_.open(view.key.frame, view.shape.grid, isFiltered(view.shape));
  slots_.emplace(view.key.frame, std::move(slot));
  queueLimit_ = std::max(queueLimit_, kMostFrames * kCopies * tasks);
}

bool Assembly::take(ReceivedTile& tile) {
  const std::lock_guard lock(mutex_);
  if (queue_.size() >= queueLimit_) return false;
  bytes_ += tile.result.encoded.size();
  queue_.push_back(std::move(tile));
  if (queue_.size() == 1) work_.notify_one();
  return true;
}

// --- workers ---

void Assembly::run(int worker) {
  TileDecoder decoder;
  std::unique_lock lock(mutex_);
  while (true) {
    work_.wait(lock, [this] { return closing_ || books_.hasTile() || !queue_.empty(); });
    if (closing_) return;
    if (books_.hasTile())  // first: it frees memory, and somebody waits for the frame
      finishOne(lock, worker);
    else
      unpackSome(lock, decoder);
  }
}

// Whoever takes work and leaves some wakes the next: nobody is woken for nothing.
void Assembly::wakeAnother() {
  if (books_.hasTile() || !queue_.empty()) work_.notify_one();
}

void Assembly::unpackSome(std::unique_lock<std::mutex>& lock, TileDecoder& decoder) {
  std::vector<Unpacking> some = takeSome();
  wakeAnother();
  lock.unlock();
  const Duration start = threadCpuTime();
  for (Unpacking& one : some) unpack(one, decoder);
  const Duration spent = threadCpuTime() - start;
  lock.lock();
  busy_.unpacking += spent;
  for (Unpacking& one : some) place(one);
  lock.unlock();
  for (Unpacking& one : some) answer_(std::move(one.tile), one.malformed);
  some.clear();
  lock.lock();
}

// Of those that wait this worker's share, but not so many that a tile has to wait for long.
std::vector<Assembly::Unpacking> Assembly::takeSome() {
  const size_t share = (queue_.size() + workers_.size() - 1) / workers_.size();
  std::vector<Unpacking> some(std::min(share, kTogether));
  for (Unpacking& one : some) {
    one.tile = std::move(queue_.front());
    queue_.pop_front();
    bytes_ -= one.tile.result.encoded.size();
    one.shape = shapeIfWanted(one.tile.result);
  }
  return some;
}

void Assembly::unpack(Unpacking& one, TileDecoder& decoder) const {
  const std::optional<TileShape>& shape = one.shape ? one.shape : one.tile.toCompare;
  try {
    if (shape) one.unpacked = decoder.unpack(std::move(one.tile.result.encoded), *shape);
    if (one.tile.toCompare) one.tile.digest = one.unpacked.digest();
  } catch (const Error& error) {
    one.malformed = error.what();
  }
  one.tile.result.encoded = {};
}

std::optional<TileShape> Assembly::shapeIfWanted(const msg::Result& result) const {
  if (!books_.isWanted(result.frame, tileOf(result), phaseOf(result))) return std::nullopt;
  const FrameShape& frame = slots_.at(result.frame)->frame.view.shape;
  const TaskRect rect = isFiltered(frame) ? pixelsOf(frame.grid, tileOf(result))
                                          : frame.grid.rect(tileOf(result), phaseOf(result));
  return TileShape{rect.width, rect.height, frame.layerMask, frame.extraMask};
}

// Only now: a malformed copy must not keep a good one out.
void Assembly::place(Unpacking& one) {
  if (!one.shape || one.malformed) return;
  const msg::Result& result = one.tile.result;
  const int tile = tileOf(result), phase = phaseOf(result);
  if (!books_.isWanted(result.frame, tile, phase)) return;
  Slot& slot = *slots_.at(result.frame);
  const int sets = slot.frame.view.shape.grid.interleave().sets();
  bytes_ += one.unpacked.bytes(), slot.bytes += one.unpacked.bytes();
  slot.frame.tasks[static_cast<size_t>(tile * sets + phase)] = std::move(one.unpacked);
  slot.lastResult = std::max(slot.lastResult, one.tile.arrived);
  books_.place(result.frame, tile, phase);
}

void Assembly::finishOne(std::unique_lock<std::mutex>& lock, int worker) {
  const uint32_t number = *books_.front();
  const int tile = *books_.nextTile();
  Slot& slot = *slots_.at(number);
  ++finishing_;
  wakeAnother();
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
  return Complete{slot.frame.view.key, slot.opened, slot.lastResult, slot.finished};
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
  wakeAnother();  // for tiles of the frame behind it
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
