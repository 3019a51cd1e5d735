#include "client/session.h"

#include <algorithm>
#include <utility>

#include "common/base/error.h"
#include "proto/scene_blobs.h"

namespace ninefold {

Session::Session(SessionOptions options, Time now)
    : options_(std::move(options)),
      backoff_(options_.seed),
      retryAt_(now),
      lastOnline_(now),
      lastTick_(now) {}

void Session::connected(Time now) {
  if (state_ != State::connecting) return;
  state_ = State::greeting;
  ++line_;
  heard_ = now;
  deadline_ = now + kWelcomeWithin;
  send(options_.hello);
}

void Session::connectFailed(const std::string& line, bool final, Time now) {
  if (state_ != State::connecting) return;
  if (final || !options_.reconnect) return end(1, line);
  lost(line, now);
}

void Session::disconnected(const std::string& reason, Time now) {
  if (online()) lost(reason, now);
}

void Session::received(Message&& message, Time now) {
  if (!online()) return;
  heard_ = now;
  try {
    std::visit([&](auto& m) { on(std::move(m), now); }, message);
  } catch (const Error& error) {
    leave(fmt::format("the master sent something impossible: {}", error.what()), now);
  }
}

void Session::on(msg::Welcome&& m, Time now) {
  if (state_ != State::greeting) fail("a second Welcome");
  if (m.release != options_.hello.release)
    return end(
        1, fmt::format("the master at {} runs Ninefold {}, this client is {}: build both from one "
                       "commit, or copy the programs of one",
                       options_.master, m.release, options_.hello.release));
  state_ = State::syncing;
  lastOnline_ = now;
  push(act::Tell{fmt::format("joined {} as client {}", options_.master, m.clientId)});
}

void Session::on(msg::Refuse&& m, Time) {
  end(1, fmt::format("the master at {} refused this client: {}", options_.master, m.reason));
}

void Session::on(msg::SceneOffer&& m, Time) {
  if (!inside()) fail("a scene before Welcome");
  checkManifest(m.blobs);
  state_ = State::syncing;
  jobs_.clear();
  states_.clear();
  sceneVersion_ = m.sceneVersion;
  const bool kept = scene_ == Scene::building || scene_ == Scene::built;
  edits_ = {};
  if (kept && m.blobs == manifest_) {
    if (std::exchange(edited_, false)) push(act::RestoreScene{load_});
    return;
  }
  manifest_ = std::move(m.blobs);
  scene_ = Scene::checking, edited_ = false;
  push(act::FindBlobs{++load_, manifest_});
}

void Session::blobsFound(uint32_t load, std::vector<BlobInfo> missing, Time now) {
  if (load != load_ || scene_ != Scene::checking) return;
  fetch_ = BlobFetch(std::move(missing));
  scene_ = Scene::fetching;
  deadline_ = now + kPieceWithin;
  nextProgress_ = now;
  continueFetch(now);
}

void Session::on(msg::BlobChunk&& m, Time now) {
  if (fetchesState()) {
    states_.chunk(std::move(m));
    return continueStateFetch(now);
  }
  if (scene_ != Scene::fetching) fail("a piece of a scene that nobody asked for");
  if (auto whole = fetch_.chunk(std::move(m)))
    push(act::KeepBlob{load_, whole->blob, std::move(whole->compressed)});
  deadline_ = now + kPieceWithin;
  continueFetch(now);
}

void Session::continueFetch(Time now) {
  for (const msg::BlobRequest& request : fetch_.requests()) send(request);
  if (!fetch_.complete()) return;
  scene_ = Scene::building;
  nextProgress_ = now;
  sendProgress(now);
  push(act::BuildScene{load_});
}

void Session::continueStateFetch(Time now) {
  if (scene_ != Scene::built) return;
  deadline_ = now + kPieceWithin;
  for (const msg::BlobRequest& request : states_.requests()) send(request);
  if (states_.isWhole() && !jobs_.empty()) prepare(jobs_.back());
}

void Session::on(msg::StateOffer&& m, Time now) {
  if (!inside() || state_ == State::ready) fail("a state that was not asked for");
  states_.offer(std::move(m));
  continueStateFetch(now);
}

void Session::on(msg::StateDelta&& m, Time) {
  if (!inside()) fail("a state before Welcome");
  states_.add(std::move(m));
}

void Session::sceneBuilt(uint32_t load, Time now) {
  if (load != load_ || scene_ != Scene::building) return;
  scene_ = Scene::built;
  EditsSoFar edits = std::exchange(edits_, {});
  if (!edits.settled.empty()) editScene(std::move(edits.settled), false);
  if (!edits.moving.empty()) editScene(std::move(edits.moving), true);
  continueStateFetch(now);
}

void Session::on(msg::Edit&& m, Time) {
  if (!inside()) fail("an edit before Welcome");
  if (scene_ != Scene::built) {
    edits_.add(m.edit, m.moving);
    if (verticesOf(edits_.settled.shapes) + verticesOf(edits_.moving.shapes) >
        2 * kMaxShapeVertices)
      fail("edits of more vertices than a scene may have changed");
    return;
  }
  editScene(std::move(m.edit), m.moving, m.more);
}

void Session::editScene(SceneEdit&& edit, bool moving, bool more) {
  edited_ = true;
  push(act::EditScene{load_, std::move(edit), moving, more});
}

void Session::on(msg::Configure&& m, Time) {
  if (!inside() || m.sceneVersion != sceneVersion_)
    fail("settings for a scene that was not offered");
  if (!jobs_.empty() && m.jobVersion <= jobs_.back().jobVersion) fail("a job older than the last");
  jobs_.push_back(std::move(m));
  if (jobs_.size() > kJobsKept) jobs_.pop_front();
  if (scene_ == Scene::built && states_.isWhole()) prepare(jobs_.back());
}

void Session::prepare(const msg::Configure& job) {
  push(act::PrepareJob{load_, line_, job.jobVersion, job.settings, job.delivery});
}

const msg::Configure* Session::findJob(uint32_t version) const {
  const auto found = std::ranges::find(jobs_, version, &msg::Configure::jobVersion);
  return found == jobs_.end() ? nullptr : &*found;
}

bool Session::jobPrepared(uint32_t load, uint32_t line, uint32_t jobVersion, Time) {
  if (load != load_ || line != line_ || !inside() || findJob(jobVersion) == nullptr) return false;
  if (state_ == State::ready) return true;
  state_ = State::ready;
  backoff_.reset();
  lastTrouble_.clear();
  send(msg::Ready{sceneVersion_, jobVersion});
  return true;
}

void Session::sceneFailed(uint32_t load, const std::string& line, Time) {
  if (load != load_) return;
  end(1, fmt::format("cannot render the scene of the master at {}: {}", options_.master, line));
}

void Session::on(msg::Tasks&& m, Time) {
  if (state_ != State::ready) fail("tasks before this client was ready");
  checkTasks(m);
  auto state = pagesOf(m.frame.state);
  push(act::StartTasks{line_, std::move(m), std::move(state)});
}

void Session::on(msg::Steps&& m, Time) {
  if (state_ != State::ready) fail("units before this client was ready");
  if (findJob(m.jobVersion) == nullptr) fail("units of a job that is not there");
  auto state = pagesOf(m.step.from);
  push(act::StartSteps{line_, std::move(m), std::move(state)});
}

std::shared_ptr<const StatePages> Session::pagesOf(uint32_t version) const {
  auto pages = states_.find(version);
  if (!pages) fail("work on version {} of the state, which is not there", version);
  return pages;
}

void Session::on(msg::CancelSteps&& m, Time) {
  if (state_ == State::ready) push(act::CancelUnits{m.number});
}

void Session::checkTasks(const msg::Tasks& tasks) const {
  const msg::Configure* job = findJob(tasks.jobVersion);
  if (job == nullptr) fail("tasks of a job that is not there");
  const Settings& s = job->settings;
  const TileGrid grid(s.width, s.height, s.interleave);
  const int phases = job->delivery.wholeTiles() ? 1 : s.interleave.sets();  // of a tile's tasks
  for (const msg::TaskItem& item : tasks.items)
    if (item.tile >= static_cast<uint32_t>(grid.tiles()) ||
        item.phase >= static_cast<uint32_t>(phases))
      fail("tile {}, phase {}: outside the picture", item.tile, item.phase);
}

void Session::on(msg::Cancel&& m, Time) {
  if (state_ == State::ready) push(act::CancelTasks{m.frame, false});
}

void Session::taskFinished(uint32_t line, msg::Result&& result, Time) {
  if (line == line_ && state_ == State::ready) send(std::move(result));
}

void Session::unitFinished(uint32_t line, msg::Stepped&& result) {
  if (line == line_ && state_ == State::ready) send(std::move(result));
}

void Session::taskFailed(const std::string& line) {
  if (online()) send(msg::Goodbye{"cannot render"});
  end(1, fmt::format("cannot render {}", line));
}

void Session::recordingFailed(const std::string& line) {
  if (online()) send(msg::Goodbye{"cannot record"});
  end(1, line);
}

void Session::tasksRefused(Time now) {
  leave("the master sent more tasks than were asked for", now);
}

void Session::on(msg::Ping&& m, Time now) {
  const auto clock = std::chrono::nanoseconds(now.time_since_epoch()).count();
  send(msg::Pong{m.clockNs, static_cast<uint64_t>(clock)});
}

void Session::on(msg::Goodbye&& m, Time) {
  end(0, fmt::format("the master at {} is done: {}", options_.master, m.reason));
}

template <typename Other>
void Session::on(Other&&, Time) {
  fail("a message that only clients send");
}

void Session::tick(Time now) {
  // A pause of our own (this process was stopped, the machine slept) is no silence of the master.
  const Duration pause = now - std::exchange(lastTick_, now);
  if (pause > std::chrono::seconds(1)) heard_ += pause, deadline_ += pause, lastOnline_ += pause;

  if (state_ == State::offline && now >= retryAt_) {
    if (now - lastOnline_ > kPatience)
      return end(1, fmt::format("no master at {} for {} minutes; start one and this client again",
                                options_.master, kPatience / std::chrono::minutes(1)));
    state_ = State::connecting;
    return push(act::Connect{});
  }
  if (!online()) return;
  lastOnline_ = now;
  if (now - heard_ > kMasterSilent) return leave("the master is silent", now);
  const bool waits = state_ == State::greeting || scene_ == Scene::fetching || fetchesState();
  if (waits && now > deadline_) return leave("the master does not answer", now);
  if (now >= nextProgress_) sendProgress(now);
}

void Session::sendProgress(Time now) {
  if (!inside()) return;
  if (scene_ == Scene::fetching)
    send(msg::Progress{Phase::fetching, fetch_.doneBytes(), fetch_.totalBytes()});
  if (scene_ == Scene::building) send(msg::Progress{Phase::building, 0, 1});
  nextProgress_ = now + kProgressEvery;
}

void Session::leave(const std::string& reason, Time now) {
  if (!online()) return;
  push(act::Disconnect{reason});
  lost(reason, now);
}

void Session::lost(const std::string& why, Time now) {
  if (!options_.reconnect)
    return end(1, fmt::format("the connection to the master ended: {}", why));
  state_ = State::offline;
  jobs_.clear();
  states_.clear();
  if (scene_ == Scene::checking || scene_ == Scene::fetching) scene_ = Scene::none, ++load_;
  push(act::CancelTasks{0, true});
  retryAt_ = now + backoff_.next();
  if (why != lastTrouble_) push(act::Tell{fmt::format("{}; trying again", why)});
  lastTrouble_ = why;
}

void Session::stop(const std::string& reason) {
  if (online()) send(msg::Goodbye{reason});
  end(0, reason);
}

void Session::end(int status, const std::string& line) {
  if (state_ == State::ended) return;
  state_ = State::ended;
  push(act::CancelTasks{0, true});
  push(act::Exit{status, line});
}

}  // namespace ninefold
