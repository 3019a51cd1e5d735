#include "master/serving/client_session.h"

#include "common/base/error.h"

namespace ninefold {
namespace {

uint64_t nanoseconds(Time time) {
  return static_cast<uint64_t>(std::chrono::nanoseconds(time.time_since_epoch()).count());
}

// As much of a text as a message may carry.
std::string clipped(const std::string& text) { return text.substr(0, kMaxText); }

}  // namespace

ClientSession::ClientSession(ClientId id, std::string peer, const JobOffer& offer,
                             StateKeeper& state, Admission& admission, Time now)
    : id_(id),
      peer_(std::move(peer)),
      offer_(offer),
      state_(state),
      admission_(admission),
      heard_(now),
      lastTick_(now),
      nextPing_(now) {
  hello_.name = peer_;  // until it has introduced itself
}

void ClientSession::received(Message&& message, Time now) {
  if (over()) return;
  heard_ = now;
  if (ready()) push(todo::Heard{});
  try {
    std::visit([&](auto& m) { on(std::move(m), now); }, message);
  } catch (const Error& error) {
    expel(error.what());
  }
}

void ClientSession::on(msg::Hello&& m, Time) {
  if (isInside()) fail("a second Hello");
  hello_ = std::move(m);
  const Admission::Verdict verdict = admission_.judge(hello_, peer_);
  if (verdict.refusal) {
    send(msg::Refuse{clipped(*verdict.refusal)});
    return finish(*verdict.refusal);
  }
  if (verdict.warning) push(todo::Warn{*verdict.warning});
  status_.state = ClientState::syncing;
  send(msg::Welcome{id_, releaseName(), admission_.pixelClass()});
  send(offer_.sceneOffer());
  if (visits()) return;
  for (msg::Edit& edit : offer_.allEdits()) send(std::move(edit));
  offered_ = state_.snapshot();
  if (offered_) send(offered_->offer);
  stateChanged(state_.since());
  send(offer_.configure());
}

void ClientSession::on(msg::BlobRequest&& m, Time) {
  if (!isInside()) fail("a request before Hello");
  if (offered_)
    if (const auto page = offered_->blobs.find(m.hash); page != offered_->blobs.end())
      return send(pieceOf(page->second, m));
  send(offer_.piece(m));
}

void ClientSession::on(msg::Progress&& m, Time now) {
  if (!isInside() || ready()) return;
  const bool building = m.phase == Phase::building;
  if (building && !buildsSince_) buildsSince_ = now;
  status_.state = building ? ClientState::building : ClientState::syncing;
  const double total = static_cast<double>(m.total);
  status_.synced = building || m.total == 0 ? 1.0 : static_cast<double>(m.done) / total;
}

void ClientSession::on(msg::Ready&& m, Time now) {
  if (!isInside() || visits() || m.sceneVersion != JobOffer::kScene || m.jobVersion > offer_.job())
    fail("ready for something that was not offered");
  if (ready()) return;  // later jobs need no answer
  status_ = {ClientState::ready, 1.0};
  offered_.reset();
  push(todo::Join{m.jobVersion, now - buildsSince_.value_or(now)});
}

void ClientSession::on(msg::Result&& m, Time) {
  if (!ready() || m.jobVersion > offer_.job()) fail("a result before it was ready");
  push(todo::TakeResult{std::move(m)});
}

void ClientSession::on(msg::Stepped&& m, Time) {
  if (!ready() || m.jobVersion > offer_.job()) fail("a result before it was ready");
  push(todo::TakeUnit{std::move(m)});
}

void ClientSession::on(msg::Ping&& m, Time now) { send(msg::Pong{m.clockNs, nanoseconds(now)}); }

void ClientSession::on(msg::Pong&& m, Time now) {
  const uint64_t clock = nanoseconds(now);
  if (ready() && m.echoNs <= clock)
    push(todo::RoundTrip{std::chrono::nanoseconds(clock - m.echoNs)});
}

void ClientSession::on(msg::Goodbye&& m, Time) { finish(m.reason); }

template <typename Other>
void ClientSession::on(Other&&, Time) {
  fail("a message that only masters send");
}

void ClientSession::tick(Time now) {
  if (over()) return;
  // A pause of our own (this process was stopped, the machine slept) is no silence of the client.
  const Duration pause = now - std::exchange(lastTick_, now);
  if (pause > kPingEvery) heard_ += pause;

  if (!isInside()) {
    if (now - heard_ > kHelloWithin) finish("it did not introduce itself in time");
    return;
  }
  if (now - heard_ > (ready() ? kDeadAfter : kDeadAfterInSync)) return finish("it is silent");
  if (now < nextPing_) return;
  nextPing_ = now + kPingEvery;
  send(msg::Ping{nanoseconds(now)});
}

void ClientSession::jobChanged(const std::vector<msg::Edit>& edits) {
  if (!isInside() || visits()) return;
  for (const msg::Edit& edit : edits) send(edit);
  send(offer_.configure());
}

void ClientSession::stateChanged(const std::vector<msg::StateDelta>& messages) {
  if (!isInside() || visits()) return;
  for (const msg::StateDelta& message : messages) send(message);
}

void ClientSession::expel(const std::string& reason) {
  if (over()) return;
  send(msg::Refuse{clipped(reason)});
  finish(reason);
}

void ClientSession::disconnected() {
  status_.state = ClientState::lost;
  offered_.reset();  // the session stays among the run's clients; a version's pages need not
}

void ClientSession::finish(const std::string& reason) {
  disconnected();
  push(todo::Finish{reason});
}

std::string ClientSession::title() const {
  return hello_.name == peer_ ? peer_ : fmt::format("{} ({})", hello_.name, peer_);
}

}  // namespace ninefold
