#include "master/running/frame_machine.h"

#include <thread>

#include "master/running/cluster_setup.h"
#include "master/running/invitation.h"

namespace ninefold {

FrameMachine::FrameMachine(const Options& options, const Listener::Keys& keys, JobOffer& offer,
                           FrameDuty duty)
    : options_(options),
      duty_(std::move(duty)),
      cluster_(clusterSetup(options, keys), offer, serverDuty()),
      assembly_(
          workers(),
          [this](ReceivedTile&& tile, const std::optional<std::string>& malformed) {
            cluster_.decoded(std::move(tile), malformed);
          },
          duty_.finishTile) {}

FrameMachine::~FrameMachine() {
  cluster_.stop("the master ends");
  cluster_.join();
}

int FrameMachine::workers() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

ServerDuty FrameMachine::serverDuty() {
  ServerDuty duty;
  duty.nextWork = [this] { return assembly_.hasRoom() ? duty_.nextWork() : std::nullopt; };
  duty.stepDone = duty_.stepDone;
  duty.take = [this](ReceivedTile& tile) {
    if (duty_.tileCame) duty_.tileCame(tile);
    return assembly_.take(tile);
  };
  const auto withAssembly = [this](const std::function<uint32_t()>& firstWantedNow) {
    return [this, firstWantedNow] {
      const uint32_t firstWanted = firstWantedNow();
      assembly_.supersede(firstWanted);
      return firstWanted;
    };
  };
  if (duty_.giveUp) duty.giveUp = withAssembly(duty_.giveUp);
  if (duty_.goBack) duty.goBack = withAssembly(duty_.goBack);
  duty.wentBack = duty_.wentBack;
  return duty;
}

void FrameMachine::start() {
  invite(options_, cluster_.endpoint());
  if (options_.announce) announcement_.emplace(cluster_.endpoint());
  cluster_.start();
}

void FrameMachine::open(const FrameOrder& order, const FrameShape& shape) {
  assembly_.open({order.key, shape, order.settings.camera, order.neighbourWeight});
}

void FrameMachine::supersede(uint32_t firstWanted) {
  assembly_.supersede(firstWanted);
  cluster_.supersede(firstWanted);
}

void FrameMachine::finishNoMore() { assembly_.close(); }

void FrameMachine::release(const Assembly::Complete& frame) {
  assembly_.release(frame);
  cluster_.wake();  // there may be room for another
}

}  // namespace ninefold
