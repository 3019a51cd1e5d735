#include "master/running/shots.h"

namespace ninefold {

Shots::Shots(Time start, double rate, int count, Write write)
    : start_(start), rate_(rate), count_(count), write_(std::move(write)), thread_([this] {
        writeAll();
      }) {}

Shots::~Shots() {
  waiting_.close();
  if (thread_.joinable()) thread_.join();
}

bool Shots::isDue(Time now) const {
  const auto next = static_cast<int>(taken_.size());
  return next < count_ && next / rate_ <= seconds(now - start_);
}

void Shots::take(Time now, const std::shared_ptr<const Shown>& shown) {
  while (isDue(now)) {
    Waiting waiting{static_cast<int>(taken_.size()), shown};
    Shot shot{waiting.number, shown->frame.order.key.frame, seconds(shown->frame.opened - start_),
              seconds(shown->completed - start_), shown->frames};
    shot.isLost = !waiting_.tryPush(waiting);
    taken_.push_back(shot);
  }
}

void Shots::writeAll() {
  while (const auto next = waiting_.pop()) {
    if (failure_) continue;
    try {
      write_(next->number, *next->shown);
    } catch (...) {
      failure_ = std::current_exception();
    }
  }
}

const std::vector<Shot>& Shots::finish() {
  waiting_.close();
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(failure_);
  return taken_;
}

}  // namespace ninefold
