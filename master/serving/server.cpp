#include "master/serving/server.h"

#include <algorithm>
#include <utility>

#include "common/base/cpu_time.h"
#include "common/base/log.h"
#include "common/scene/methods.h"
#include "master/scheduling/task_rays.h"
#include "proto/tile_names.h"

namespace ninefold {
namespace {

// Frames that may be open at once: enough for 144 clients with a light set of their own at rest, if
// there is memory for all (Assembly::hasRoom).
constexpr int kMaxOpenFrames = 16;

// Ticks come much closer together: whatever is longer is a pause of this process or its machine.
constexpr Duration kPause = std::chrono::seconds(1);

TaskId taskOf(const msg::Result& result) {
  return {result.frame, static_cast<int>(result.tile), static_cast<int>(result.phase)};
}

TaskCost costOf(const msg::Result& result) {
  return {std::chrono::nanoseconds(result.busyNs), result.setsMade > 0};
}

std::string describe(const ClientSession& session) {
  const msg::Hello& hello = session.hello();
  return hello.name == session.peer() ? session.peer()
                                      : fmt::format("{} ({})", hello.name, session.peer());
}

}  // namespace

Server::Server(EventLoop& loop, ServerSetup setup, JobOffer& offer, ServerDuty duty)
    : loop_(loop), setup_(std::move(setup)), offer_(offer), duty_(std::move(duty)) {
  Listener::Events events;
  events.onConnection = [this](std::shared_ptr<Connection> c) { accept(std::move(c)); };
  events.onRefused = [](const std::string& line) { warn("{}", line); };
  listener_ = Listener::open(loop_, setup_.listen, setup_.keys, std::move(events));
}

Server::~Server() = default;

void Server::accept(std::shared_ptr<Connection> connection) {
  const ClientId id = nextId_++;
  Peer& peer = peers_[id];
  peer.connection = std::move(connection);
  peer.session = std::make_unique<ClientSession>(id, peer.connection->peer(), offer_, admission_,
                                                 Clock::now());
  Connection::Events events;
  events.onMessage = [this, id](Message&& message) {
    withPeer(id, [&](ClientSession& s, Time now) { s.received(std::move(message), now); });
  };
  events.onClosed = [this, id](const std::string& reason) { closed(id, reason); };
  peer.connection->start(std::move(events));
}

void Server::closed(ClientId id, const std::string& reason) {
  Handle& peer = *peers_.find(id);
  peer.second.bytesReceived = peer.second.connection->bytesReceived();
  if (!isClosing() && !peer.second.session->over()) {
    peer.second.session->disconnected();
    lost(peer, reason, Clock::now());
    dispatchSoon();
  }
  peer.second.connection.reset();
}

template <typename Event>
void Server::withPeer(ClientId id, Event event) {
  const auto found = peers_.find(id);
  const Time now = Clock::now();
  event(*found->second.session, now);
  carryOut(*found, now);
  dispatchSoon();
}

void Server::carryOut(Handle& peer, Time now) {
  for (todo::Action& action : peer.second.session->takeActions())
    std::visit([&](auto& a) { on(peer, std::move(a), now); }, action);
}

void Server::on(Handle& peer, todo::Send&& a, Time) {
  if (peer.second.connection) peer.second.connection->send(std::move(a.message));
}

void Server::on(Handle&, todo::Warn&& a, Time) { warn("{}", a.line); }

void Server::on(Handle& peer, todo::Join&& a, Time now) {
  peer.second.wasReady = true;
  lastMove_ = now;
  const ClientSession& session = *peer.second.session;
  log("client {} is ready: {}, {} thread(s), {}", peer.first, describe(session),
      session.hello().threads, session.hello().isa);
  joining_[peer.first] = a;
  letJoin(now);
}

// A client that has missed the job of an open frame must get no task of it.
void Server::letJoin(Time now) {
  const auto canDoAll = [&](uint32_t job) {
    return std::ranges::all_of(open_, [&](const auto& frame) { return frame.second.job >= job; });
  };
  std::erase_if(joining_, [&](const auto& client) {
    const auto& [id, join] = client;
    if (!canDoAll(join.job)) return false;
    const int threads = static_cast<int>(peers_.at(id).session->hello().threads);
    scheduler_.clientJoined(id, threads, now, join.sceneTime);
    return true;
  });
}

// Those who had the job of an open frame are gone or stuck.
void Server::giveUpOpenFrames(Time now) {
  const bool nobodyCan = scheduler_.clients() == 0 || scheduler_.allAreStuck();
  if (joining_.empty() || !nobodyCan || !duty_.giveUp) return;
  const uint32_t firstWanted = duty_.giveUp();
  scheduler_.viewChanged(firstWanted, now);
  std::erase_if(open_, [&](const auto& frame) { return frame.first < firstWanted; });
  letJoin(now);
}

void Server::on(Handle& peer, todo::Heard&&, Time now) {
  if (!joining_.contains(peer.first)) scheduler_.clientHeard(peer.first, now);
}

void Server::on(Handle& peer, todo::RoundTrip&& a, Time) {
  if (!joining_.contains(peer.first)) scheduler_.roundTripMeasured(peer.first, a.time);
}

void Server::on(Handle& peer, todo::TakeResult&& a, Time now) {
  lastMove_ = now;
  const TaskId task = taskOf(a.result);
  if (!isAccepted(scheduler_.verdictOn(peer.first, task))) {
    scheduler_.resultArrived(peer.first, task, costOf(a.result), now);  // counts why it is dropped
    return;
  }
  ReceivedTile tile{peer.first, std::move(a.result), now};
  if (!duty_.take(tile)) peer.second.session->expel("more results than were asked for");
}

void Server::on(Handle& peer, todo::Finish&& a, Time now) {
  if (peer.second.connection) peer.second.connection->finish(a.reason);
  lost(peer, a.reason, now);
}

void Server::lost(Handle& peer, const std::string& reason, Time now) {
  log("client {} is gone: {}: {}", peer.first, describe(*peer.second.session), reason);
  joining_.erase(peer.first);
  scheduler_.clientLost(peer.first, now);
}

void Server::decoded(const ReceivedTile& tile, const std::optional<std::string>& malformed,
                     Time now) {
  const auto peer = peers_.find(tile.client);
  if (malformed) {
    ++tally_.malformed;
    peer->second.session->expel(*malformed);
    carryOut(*peer, now);
    return dispatchSoon();
  }
  const Verdict verdict =
      scheduler_.resultArrived(tile.client, taskOf(tile.result), costOf(tile.result), now);
  if (isAccepted(verdict)) count(tile);
  if (verdict == Verdict::completedFrame) {
    tally_.lastCompletion = now;
    open_.erase(tile.result.frame);
  }
  dispatchSoon();
}

// Tells of the first tile with values that are no light, then of the tenth, the hundredth, ...
void Server::count(const ReceivedTile& tile) {
  const msg::Result& result = tile.result;
  tally_.rays += result.rays;
  tally_.replaced += result.replaced;
  if (result.replaced == 0) return;
  if (++spoilt_ < spoiltTold_) return;
  spoiltTold_ = 10 * spoilt_;
  warn(
      "frame {}, tile {}, phase {} of client {}, {}: {} values are not finite or negative, in {}, "
      "and count as 0: the picture is too dark there; {} such tile(s) so far, of which only each "
      "tenfold is told; please report the scene",
      result.frame, result.tile, result.phase, tile.client,
      describe(*peers_.at(tile.client).session), result.replaced, namesOfFields(result.replacedIn),
      spoilt_);
}

void Server::supersede(uint32_t firstWanted, Time now) {
  scheduler_.viewChanged(firstWanted, now);
  std::erase_if(open_, [&](const auto& frame) { return frame.first < firstWanted; });
  dispatch(now);
}

void Server::tick(Time now) {
  std::erase_if(peers_, [](const Handle& peer) {  // those that were never ready leave no trace
    return peer.second.connection == nullptr && !peer.second.wasReady;
  });
  if (isClosing()) return;
  for (Handle& peer : peers_) {
    if (peer.second.session->over()) continue;
    peer.second.session->tick(now);
    carryOut(peer, now);
  }
  dispatch(now);
}

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
    if (const auto& connection = peers_.at(cancel.client).connection)
      connection->send(msg::Cancel{offer_.job(), cancel.firstWanted});
  sendTasks(actions.assign);
  for (const StuckNote& note : actions.notes) tell(note);
}

void Server::tell(const StuckNote& note) const {
  const std::string client =
      fmt::format("client {}, {},", note.client, describe(*peers_.at(note.client).session));
  if (note.isBack)
    log("{} is back after being stuck for {:.0f} s", client, seconds(note.time));
  else
    warn("{} is stuck: {} is not done after {:.0f} s; its tasks go to others", client,
         nameOf(note.task), seconds(note.time));
}

void Server::openFrames(Time) {
  while (scheduler_.wantsFrame() && scheduler_.openFrames() < kMaxOpenFrames) {
    const std::optional<FrameOrder> order = duty_.nextWork();
    if (!order) return;
    if (order->job != offer_.job()) announce(*order);
    open_[order->key.frame] = *order;
    scheduler_.openFrame(order->key, order->grid(),
                         {.wholeTiles = order->delivery.wholeTiles(),
                          .urgent = order->urgent,
                          .freeSets = factsOf(order->settings.method).freeSets,
                          .rays = raysOfTask(*order)});
  }
}

void Server::announce(const FrameOrder& order) {
  std::optional<msg::Edit> edit;
  if (order.scene != offer_.edits()) edit = offer_.setEdit(order.scene, order.edit, order.moving);
  offer_.setJob(order.job, order.settings, order.delivery);
  for (Handle& peer : peers_) {
    peer.second.session->jobChanged(edit ? &*edit : nullptr);
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
    Bundle& bundle = bundles[{a.client, a.task.frame}];
    bundle.items.push_back({static_cast<uint32_t>(a.task.tile), static_cast<uint32_t>(a.task.phase),
                            open_.at(a.task.frame).extraMask});
    bundle.allowed = a.allowed;
  }
  if (!bundles.empty() && !tally_.firstDispatch) {
    tally_.firstDispatch = Clock::now();
    tally_.cpuAtDispatch = processCpuTime();
  }
  for (auto& [to, bundle] : bundles) {
    const FrameOrder& frame = open_.at(to.second);
    if (const auto& connection = peers_.at(to.first).connection)
      connection->send(msg::Tasks{frame.job, frame.key, std::move(bundle.items),
                                  frame.neighbourWeight, frame.urgent, bundle.allowed});
  }
}

void Server::close(const std::string& reason) {
  listener_.reset();
  for (auto& [id, peer] : peers_) {
    if (!peer.connection) continue;
    peer.connection->send(msg::Goodbye{reason.substr(0, kMaxText)});
    peer.connection->finish(reason);
  }
}

std::optional<ClientReport> Server::workOf(const std::string& name, Time now) const {
  std::optional<ClientReport> latest;
  for (const ClientReport& report : scheduler_.report(now))
    if (peers_.at(report.client).session->hello().name == name) latest = report;
  return latest;
}

bool Server::nothingMoves() const {
  const auto isComing = [](const Handle& peer) {
    const ClientSession& session = *peer.second.session;
    return !session.over() && !session.ready();
  };
  return scheduler_.allAreStuck() && joining_.empty() && std::ranges::none_of(peers_, isComing);
}

std::string Server::stuckTasks(Time now) const {
  constexpr size_t kLongEnough = 150;
  std::string text;
  for (const ClientReport& report : scheduler_.report(now)) {
    if (!report.stuck || !report.oldest) continue;
    if (text.size() > kLongEnough) return text + ", ...";
    text += fmt::format("{}client {} in {}", text.empty() ? "" : ", ", report.client,
                        nameOf(*report.oldest));
  }
  return text;
}

std::vector<std::string> Server::explain(Time now) const {
  std::vector<std::string> lines = scheduler_.explainFrames(now);
  if (!started_)
    lines.push_back(fmt::format("no frame yet: {} of {} clients are ready (--wait-clients)",
                                scheduler_.clients(), setup_.waitClients));
  else if (lines.empty())
    lines.emplace_back("no frame is open: none is wanted, or there is no room for one");
  for (const auto& [id, peer] : peers_)
    if (!peer.session->over())
      lines.push_back(fmt::format("client {}, {}: {}", id, describe(*peer.session),
                                  explainClient(id, *peer.session, now)));
  return lines;
}

std::string Server::explainClient(ClientId id, const ClientSession& session, Time now) const {
  switch (session.status().state) {
    case ClientState::connecting:
      return "has not introduced itself";
    case ClientState::syncing:
      return fmt::format("has {:.0f} % of the scene", 100 * session.status().synced);
    case ClientState::building:
      return "builds the scene";
    default:
      break;
  }
  if (joining_.contains(id))
    return "is ready and waits: open frames are of a job that it has missed";
  return scheduler_.explainClient(id, now);
}

bool Server::isConnected() const {
  return std::ranges::any_of(peers_, [](const auto& p) { return p.second.connection != nullptr; });
}

ServerTally Server::tally() const {
  ServerTally tally = tally_;
  tally.tasks = scheduler_.counts();
  tally.reproducible = admission_.reproducible();
  for (const auto& [id, peer] : peers_)
    tally.bytesReceived += peer.connection ? peer.connection->bytesReceived() : peer.bytesReceived;
  return tally;
}

std::vector<ClientInfo> Server::clients(Time now) const {
  std::map<ClientId, ClientReport> work;
  for (const ClientReport& report : scheduler_.report(now)) work[report.client] = report;
  std::vector<ClientInfo> infos;
  for (const auto& [id, peer] : peers_) {
    const ClientSession& session = *peer.session;
    ClientInfo info{id, session.hello().name, session.hello().isa, session.peer(), session.status(),
                    {}};
    if (const auto found = work.find(id); found != work.end()) info.work = found->second;
    infos.push_back(std::move(info));
  }
  return infos;
}

}  // namespace ninefold
