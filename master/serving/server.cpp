#include "master/serving/server.h"

#include <algorithm>
#include <utility>

#include "common/base/log.h"
#include "common/scene/methods.h"
#include "proto/tile_names.h"

namespace ninefold {
namespace {

TaskId taskOf(const msg::Result& result) {
  return {result.frame, static_cast<int>(result.tile), static_cast<int>(result.phase)};
}

TaskId taskOf(const msg::Stepped& result) {
  return {result.number, static_cast<int>(result.unit), 0};
}

TaskCost costOf(const msg::Result& result) {
  return {std::chrono::nanoseconds(result.busyNs), result.setsMade > 0};
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
  peer.session = std::make_unique<ClientSession>(id, peer.connection->peer(), offer_, state_,
                                                 admission_, Clock::now());
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
  if (peer.second.session->visits()) peers_.erase(id);
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
  ClientSession& session = *peer.second.session;
  // Carrying one out may expel the client, which gives more of them.
  for (auto actions = session.takeActions(); !actions.empty(); actions = session.takeActions())
    for (todo::Action& action : actions)
      std::visit([&](auto& a) { on(peer, std::move(a), now); }, action);
}

void Server::on(Handle& peer, todo::Send&& a, Time) {
  if (auto* welcome = std::get_if<msg::Welcome>(&a.message)) welcome->wallClockMs = wallClockMs();
  if (peer.second.connection) peer.second.connection->send(std::move(a.message));
}

void Server::on(Handle&, todo::Warn&& a, Time) { warn("{}", a.line); }

void Server::on(Handle& peer, todo::Join&& a, Time now) {
  peer.second.wasReady = true;
  lastMove_ = now;
  const ClientSession& session = *peer.second.session;
  log("client {} is ready: {}, {} thread(s), {}", peer.first, session.title(),
      session.hello().threads, session.hello().isa);
  joining_[peer.first] = a;
  letJoin(now);
}

// A client that has missed the job of an open frame must get no task of it.
void Server::letJoin(Time now) {
  const auto canDoAll = [&](uint32_t job) {
    return std::ranges::all_of(open_, [&](const auto& f) { return f.second.job >= job; }) &&
           std::ranges::all_of(openSteps_,
                               [&](const auto& s) { return s.second.order.job >= job; });
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
  dropSteps(firstWanted, now);
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

void Server::on(Handle& peer, todo::TakeUnit&& a, Time now) {
  lastMove_ = now;
  const uint32_t number = a.result.number;
  const TaskId task = taskOf(a.result);
  const TaskCost cost(std::chrono::nanoseconds(a.result.busyNs));
  if (isAccepted(scheduler_.verdictOn(peer.first, task))) {
    tally_.rays += a.result.rays;
    tally_.stepBytesReceived += a.result.deltas.size();
    try {
      state_.take(std::move(a.result));
    } catch (const Error& error) {
      ++tally_.malformed;
      return peer.second.session->expel(error.what());
    }
  }
  const Verdict verdict = scheduler_.resultArrived(peer.first, task, cost, now);
  if (verdict == Verdict::completedFrame) finishStep(number, now);
}

void Server::finishStep(uint32_t number, Time now) {
  const OpenStep step = openSteps_.at(number);
  openSteps_.erase(number);
  tally_.inSteps += now - step.since;
  try {
    sendVersion(state_.complete(number), now);
    describe(step.order.settings);
  } catch (const Error& error) {
    failure_ = error.what();
    return;
  }
  if (duty_.stepDone) duty_.stepDone(step.order.key);
}

// A line in the log, when the latest version tells people something new.
void Server::describe(const Settings& settings) {
  const StateFacts* facts = factsOf(settings.method).state;
  if (facts == nullptr || facts->describe == nullptr) return;
  const std::string text = facts->describe(state_.latest());
  std::string told = text.substr(0, text.find(','));
  if (told != described_) log("{}", text);
  described_ = std::move(told);
}

void Server::sendVersion(const std::vector<msg::StateDelta>& messages, Time now) {
  for (Handle& peer : peers_) {
    if (!peer.second.session->isInside()) continue;
    peer.second.session->stateChanged(messages);
    for (const msg::StateDelta& message : messages) tally_.stepBytesSent += message.deltas.size();
    carryOut(peer, now);
  }
}

void Server::on(Handle& peer, todo::Finish&& a, Time now) {
  if (peer.second.connection) peer.second.connection->finish(a.reason);
  lost(peer, a.reason, now);
}

void Server::lost(Handle& peer, const std::string& reason, Time now) {
  if (peer.second.session->visits())
    return log("{} has looked whether it can join: {}", peer.second.session->title(), reason);
  log("client {} is gone: {}: {}", peer.first, peer.second.session->title(), reason);
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
      result.frame, result.tile, result.phase, tile.client, peers_.at(tile.client).session->title(),
      result.replaced, namesOfFields(result.replacedIn), spoilt_);
}

void Server::supersede(uint32_t firstWanted, Time now) {
  scheduler_.viewChanged(firstWanted, now);
  std::erase_if(open_, [&](const auto& frame) { return frame.first < firstWanted; });
  dispatch(now);
}

void Server::cancelSteps(uint32_t firstWanted, Time now) {
  dropSteps(firstWanted, now);
  dispatch(now);
}

void Server::dropSteps(uint32_t firstWanted, Time now) {
  scheduler_.stateChanged(firstWanted, now);
  state_.drop(firstWanted);
  std::erase_if(openSteps_, [&](const auto& step) { return step.first < firstWanted; });
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

void Server::close(const std::string& reason) {
  listener_.reset();
  for (auto& [id, peer] : peers_) {
    if (!peer.connection) continue;
    peer.connection->send(msg::Goodbye{reason.substr(0, kMaxText)});
    peer.connection->finish(reason);
  }
}

}  // namespace ninefold
