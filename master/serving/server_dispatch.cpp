// server_dispatch.cpp: how work goes out: frames are opened, tasks assigned and sent.
#include "common/base/cpu_time.h"
#include "common/base/log.h"
#include "common/scene/methods.h"
#include "master/scheduling/task_rays.h"
#include "master/serving/server.h"

namespace ninefold {
namespace {

// Frames that may be open at once: enough for 144 clients with a light set of their own at rest, if
// there is memory for all (Assembly::hasRoom).
constexpr int kMaxOpenFrames = 16;

// Ticks come much closer together: whatever is longer is a pause of this process or its machine.
constexpr Duration kPause = std::chrono::seconds(1);

}  // namespace

// Once for all that the loop has at hand: many results often come together.
void Server::dispatchSoon() {
  if (std::exchange(dispatchWaits_, true)) return;
  loop_.post([this, weak = std::weak_ptr(alive_)] {
    if (weak.expired()) return;
    dispatchWaits_ = false;
    dispatch(Clock::now());
  });
}

void Server::dispatch(Time now) {
  if (isClosing()) return;
  const Duration passed = now - lastDispatch_.value_or(now);
  lastDispatch_ = now;
  if (passed > kPause) scheduler_.paused(passed);
  letJoin(now);
  giveUpOpenFrames(now);
  started_ = started_ || scheduler_.clients() >= setup_.waitClients;
  if (!started_) return;
  openFrames(now);  // first: while there is a frame to open, nothing needs a second copy
  const Actions actions = scheduler_.poll(now);
  for (const Cancellation& cancel : actions.cancel)
    if (const auto& connection = peers_.at(cancel.client).connection) {
      if (cancel.steps)
        connection->send(msg::CancelSteps{cancel.firstWanted});
      else
        connection->send(msg::Cancel{offer_.job(), cancel.firstWanted});
    }
  sendUnits(actions.assign);
  sendTasks(actions.assign);
  for (const StuckNote& note : actions.notes) tell(note);
  for (const WrongNote& note : actions.wrong) expel(note, now);
  if (!actions.wrong.empty()) goBack(now);
  settle();
}

void Server::expel(const WrongNote& note, Time now) {
  Handle& peer = *peers_.find(note.client);
  const std::string reason = fmt::format(
      "its result for {} is wrong: two others gave something else; look after its memory and "
      "processor",
      nameOf(note.task));
  if (peer.second.session->over())
    return warn("client {}, {}, is gone already, but {}", note.client, peer.second.session->title(),
                reason);
  ++tally_.expelled;
  peer.second.session->expel(reason);
  carryOut(peer, now);
}

void Server::goBack(Time now) {
  scheduler_.unmark();
  markWanted_.reset(), marked_.reset();
  if (duty_.goBack) voidBefore(duty_.goBack(), now);
  if (duty_.wentBack) duty_.wentBack();
}

// What was kept so that others could do it again; and a mark, once all before it is there.
void Server::settle() {
  if (setup_.verify == 0) return;
  std::erase_if(open_, [this](const auto& f) { return !scheduler_.isNeeded(f.first); });
  std::erase_if(openSteps_, [this](const auto& s) { return !scheduler_.isNeeded(s.first); });
  if (!markWanted_ || scheduler_.firstUnsettled() <= *markWanted_) return;
  scheduler_.mark();
  marked_ = std::exchange(markWanted_, std::nullopt);
}

void Server::tell(const StuckNote& note) const {
  const std::string client =
      fmt::format("client {}, {},", note.client, peers_.at(note.client).session->title());
  if (note.isBack)
    log("{} is back after being stuck for {:.0f} s", client, seconds(note.time));
  else
    warn("{} is stuck: {} is not done after {:.0f} s; its tasks go to others", client,
         nameOf(note.task), seconds(note.time));
}

void Server::openFrames(Time now) {
  while (scheduler_.wantsFrame() && scheduler_.openFrames() < kMaxOpenFrames) {
    const std::optional<WorkOrder> work = duty_.nextWork();
    if (!work) return;
    if (const auto* frame = std::get_if<FrameOrder>(&*work))
      open(*frame);
    else
      open(std::get<StepOrder>(*work), now);
  }
}

void Server::open(const FrameOrder& order) {
  if (order.job != offer_.job()) announce(order);
  open_[order.key.frame] = order;
  scheduler_.openFrame(order.key, order.grid(),
                       {.wholeTiles = order.delivery.wholeTiles(),
                        .urgent = order.urgent,
                        .freeSets = factsOf(order.settings.method).freeSets,
                        .rays = raysOfTask(order)});
  forgetStates();
}

void Server::open(const StepOrder& order, Time now) {
  if (order.job != offer_.job()) announce(order);
  openSteps_[order.key.number] = {order, now};
  state_.open(order.key);
  scheduler_.openStep(order.key.number, order.key.firstUnit, static_cast<int>(order.key.units),
                      factsOf(order.settings.method).state->rays(order.settings), order.yields);
  forgetStates();
}

// Versions that nothing open names. The latest may be named yet: frames are opened in the order of
// versions, and a step only while one version at most waits for its frame (StatePlan).
void Server::forgetStates() {
  uint32_t oldest = state_.version();
  for (const auto& [number, frame] : open_) oldest = std::min(oldest, frame.key.state);
  for (const auto& [number, step] : openSteps_)
    if (step.order.key.from > 0) oldest = std::min(oldest, step.order.key.from);
  state_.forget(std::min(oldest, keptFrom_));
}

void Server::announce(const JobOrder& order) {
  std::vector<msg::Edit> edits;
  if (order.scene != offer_.edits()) edits = offer_.setEdit(order.scene, order.edit, order.moving);
  offer_.setJob(order.job, order.settings, order.delivery);
  for (Handle& peer : peers_) {
    peer.second.session->jobChanged(edits);
    carryOut(peer, Clock::now());
  }
}

void Server::sendTasks(const std::vector<Assignment>& assignments) {
  struct Bundle {
    std::vector<msg::TaskItem> items;
    Duration allowed{0};
  };
  std::map<std::pair<ClientId, uint32_t>, Bundle> bundles;
  for (const Assignment& a : assignments) {
    if (openSteps_.contains(a.task.frame)) continue;
    Bundle& bundle = bundles[{a.client, a.task.frame}];
    bundle.items.push_back({static_cast<uint32_t>(a.task.tile), static_cast<uint32_t>(a.task.phase),
                            open_.at(a.task.frame).extraMask});
    bundle.allowed = a.allowed;
  }
  if (!bundles.empty()) noteDispatch();
  for (auto& [to, bundle] : bundles) {
    const FrameOrder& frame = open_.at(to.second);
    if (const auto& connection = peers_.at(to.first).connection)
      connection->send(msg::Tasks{frame.job, frame.key, std::move(bundle.items),
                                  frame.neighbourWeight, frame.urgent, bundle.allowed});
  }
}

void Server::sendUnits(const std::vector<Assignment>& assignments) {
  std::map<std::pair<ClientId, uint32_t>, msg::Steps> bundles;
  for (const Assignment& a : assignments) {
    const auto step = openSteps_.find(a.task.frame);
    if (step == openSteps_.end()) continue;
    msg::Steps& bundle = bundles[{a.client, a.task.frame}];
    bundle.jobVersion = step->second.order.job;
    bundle.step = step->second.order.key;
    bundle.units.push_back(static_cast<uint32_t>(a.task.tile));
    bundle.allowed = a.allowed;
  }
  if (!bundles.empty()) noteDispatch();
  for (auto& [to, bundle] : bundles)
    if (const auto& connection = peers_.at(to.first).connection)
      connection->send(std::move(bundle));
}

void Server::noteDispatch() {
  if (tally_.firstDispatch) return;
  tally_.firstDispatch = Clock::now();
  tally_.cpuAtDispatch = processCpuTime();
}

}  // namespace ninefold
