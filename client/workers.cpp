#include "client/workers.h"

namespace ninefold {

Workers::Workers(int threads, size_t capacity) : queue_(capacity) {
  for (int thread = 0; thread < threads; ++thread)
    threads_.emplace_back([this, thread] { run(thread); });
}

Workers::~Workers() {
  cancel([](uint32_t, bool) { return true; });
  queue_.close();
  for (std::thread& thread : threads_) thread.join();
}

bool Workers::start(uint32_t frame, Job job, bool isStep) {
  Entry entry{frame, isStep, std::move(job)};
  return queue_.tryPush(entry);
}

size_t Workers::cancel(const std::function<bool(uint32_t frame, bool isStep)>& drop) {
  return queue_.removeIf([&](const Entry& entry) { return drop(entry.frame, entry.isStep); })
      .size();
}

void Workers::run(int thread) {
  while (auto entry = queue_.pop()) entry->job(thread);
}

}  // namespace ninefold
