#include "proto/event_loop.h"

#include "proto/asio.h"

namespace ninefold {
namespace {

class AsioTimer : public EventLoop::Timer {
 public:
  AsioTimer(asio::io_context& io, Duration delay, std::function<void()> work)
      : timer_(io, delay), work_(std::make_shared<std::function<void()>>(std::move(work))) {
    timer_.async_wait([weak = std::weak_ptr(work_)](NetError error) {
      // The wait may already have been over when the timer was dropped.
      const auto work = weak.lock();
      if (!error && work) (*work)();
    });
  }

 private:
  asio::steady_timer timer_;
  std::shared_ptr<std::function<void()>> work_;
};

void awaitSignal(asio::signal_set& set, std::function<void(int)> work) {
  set.async_wait([&set, work = std::move(work)](NetError error, int signal) {
    if (error) return;
    work(signal);
    awaitSignal(set, work);
  });
}

}  // namespace

EventLoop::EventLoop() : impl_(std::make_unique<Impl>()) {}
EventLoop::~EventLoop() = default;

void EventLoop::run() {
  impl_->io.run();
  impl_->io.restart();  // a stop() is used up
}
void EventLoop::stop() { impl_->io.stop(); }
void EventLoop::post(std::function<void()> work) { asio::post(impl_->io, std::move(work)); }

std::unique_ptr<EventLoop::Timer> EventLoop::after(Duration delay, std::function<void()> work) {
  return std::make_unique<AsioTimer>(impl_->io, delay, std::move(work));
}

void EventLoop::onSignal(const std::vector<int>& signals, std::function<void(int)> work) {
  auto& set = impl_->signals.emplace_back(std::make_unique<asio::signal_set>(impl_->io));
  for (const int signal : signals) set->add(signal);
  awaitSignal(*set, std::move(work));
}

}  // namespace ninefold
