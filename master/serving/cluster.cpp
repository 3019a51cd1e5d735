#include "master/serving/cluster.h"

#include <signal.h>

#include <cstdlib>

#include "common/base/log.h"
#include "common/base/process.h"

namespace ninefold {
namespace {

constexpr Duration kTick = milliseconds(20);
constexpr Duration kTimeToEnd = milliseconds(900);

StartedClients::Plan withMaster(StartedClients::Plan plan, const Endpoint& master) {
  plan.arguments.push_back("--master=" + addressText(master));
  return plan;
}

// The part of a summary for clients in one state: "2 ready".
void append(std::string& text, int count, const char* what) {
  if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
}

}  // namespace

Cluster::Cluster(ClusterSetup setup, JobOffer& offer, ServerDuty duty)
    : remoteMayJoin_(setup.remoteMayJoin),
      hasHosts_(!setup.hosts.empty()),
      savesOnRequest_(setup.savesOnRequest),
      server_(loop_, std::move(setup.server), offer, std::move(duty)),
      local_(withMaster(std::move(setup.local), server_.endpoint()),
             [this](const std::string& name) { return workOf(name); }),
      hosts_(hostPlan(setup.hosts, local_.key(), server_.endpoint(), setup.isa),
             [this](const std::string& name) { return workOf(name); }),
      stall_(setup.patience) {
  watchSignals();  // before anybody is told that the master listens
}

Cluster::~Cluster() {
  stop("the master ends");
  join();
}

void Cluster::start() {
  thread_ = std::thread([this] { run(); });
}

void Cluster::watchSignals() {
  loop_.onSignal(endingSignals(), [this](int signal) {
    int none = 0;
    signal_.compare_exchange_strong(none, signal);
    // A terminal that closes sends more than one; only who asks twice is in a hurry.
    const bool isAsked = signal == SIGINT || signal == SIGTERM;
    // Local clients follow: the kernel kills them with us.
    if (isAsked && ++asked_ > 1) std::_Exit(128 + signal);
  });
  loop_.onSignal({SIGUSR1}, [this](int) { askForSave(); });
  loop_.onSignal({SIGUSR2}, [this](int) { tellState(); });
}

void Cluster::askForSave() {
  saveAsked_ = true;
  if (!savesOnRequest_)
    warn("SIGUSR1 asks for the picture so far: only a run of one picture at rest saves it so");
}

void Cluster::tellState() const {
  const Time now = Clock::now();
  log("state: {}", describeClients());
  for (const std::string& line : server_.explain(now)) log("state: {}", line);
}

void Cluster::run() {
  takeSignal(SIGUSR1, true), takeSignal(SIGUSR2, true);
  try {
    local_.start(Clock::now());
    hosts_.start(Clock::now());
    tick();
    loop_.run();
  } catch (const Error& error) {
    fail(error.what());
  }
}

void Cluster::tick() {
  const Time now = Clock::now();
  local_.poll(now);
  hosts_.poll(now);
  server_.tick(now);
  if (isOver(now)) return loop_.stop();
  if (!server_.failure().empty()) fail(server_.failure());
  watchForStall(now);
  if (local_.exhausted() && server_.readyClients() == 0) failWithoutClients();
  {
    const std::lock_guard lock(mutex_);
    clients_ = server_.clients(now);
    tally_ = server_.tally();
    summary_ = describeClients();
    firstDispatch_ = tally_.firstDispatch;
  }
  timer_ = loop_.after(kTick, [this] { tick(); });
}

StartedClients::Work Cluster::workOf(const std::string& name) const {
  const std::optional<ClientReport> work = server_.workOf(name, Clock::now());
  if (!work) return {.oldestTask = "no task"};
  return {work->tasks, work->oldest ? nameOf(*work->oldest) : "no task"};
}

void Cluster::watchForStall(Time now) {
  const bool isAlone = server_.readyClients() == 0;
  const bool isStarting = local_.isStarting(now) || (isAlone && hosts_.isStarting(now));
  const bool isTold = stall_.look(!endBy_ && !isStarting && server_.nothingMoves(), now);
  if (!isTold && !stall_.isOver()) return;
  const double since = seconds(isAlone ? stall_.time() : now - server_.lastMove());
  if (isTold)
    warn("{}{}",
         isAlone ? "no client is left" + (since < 1 ? "" : fmt::format(" since {:.0f} s", since))
                 : fmt::format("nothing has moved for {:.0f} s: all clients are stuck", since),
         othersMayJoin() ? "; others may join" : "");
  if (!stall_.isOver() || (isAlone && othersMayJoin())) return;
  fail(isAlone ? hosts_.hang().value_or(fmt::format(
                     "no client has been there for {:.0f} s; --patience S waits longer", since))
               : fmt::format("all clients are stuck and nothing has moved for {:.0f} s: {}; "
                             "--patience S waits longer",
                             since, server_.stuckTasks(now)));
}

// Any that have the key, or those of --hosts, which are tried for ever unless they hang.
bool Cluster::othersMayJoin() const { return remoteMayJoin_ || (hasHosts_ && !hosts_.exhausted()); }

// A window waits for remote clients, if there may be any.
void Cluster::failWithoutClients() {
  if (local_.hang() && (!othersMayJoin() || !stall_.isEndless()))
    fail(*local_.hang());
  else if (!othersMayJoin())
    fail("all local clients ended and none can be started; see the lines above");
}

bool Cluster::isOver(Time now) const {
  const bool isAlone = local_.running() + hosts_.running() == 0 && !server_.isConnected();
  return endBy_ && (isAlone || now >= *endBy_);
}

void Cluster::fail(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (!failure_) failure_ = line;
}

std::optional<std::string> Cluster::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

std::string Cluster::summary() const {
  const std::lock_guard lock(mutex_);
  return summary_;
}

std::optional<Time> Cluster::firstDispatch() const {
  const std::lock_guard lock(mutex_);
  return firstDispatch_;
}

std::string Cluster::describeClients() const {
  int connecting = 0, building = 0, ready = 0, stuck = 0, lost = 0;
  std::string syncing;
  for (const ClientInfo& client : clients_) {
    connecting += client.status.state == ClientState::connecting ? 1 : 0;
    building += client.status.state == ClientState::building ? 1 : 0;
    const bool isReady = client.status.state == ClientState::ready;
    stuck += isReady && client.isStuck() ? 1 : 0;
    ready += isReady && !client.isStuck() ? 1 : 0;
    lost += client.status.state == ClientState::lost ? 1 : 0;
    if (client.status.state == ClientState::syncing)
      syncing += fmt::format("{}{} syncing {:.0f}%", syncing.empty() ? "" : ", ", client.name,
                             100 * client.status.synced);
  }
  std::string text;
  append(text, ready, "ready");
  append(text, stuck, "stuck");
  append(text, building, "building the scene");
  append(text, connecting, "connecting");
  append(text, lost, "lost");
  if (!text.empty() && !syncing.empty()) text += ", ";
  text += syncing;
  return text.empty() ? "no client yet" : text;
}

std::vector<ClientInfo> Cluster::clients() const {
  const std::lock_guard lock(mutex_);
  return clients_;
}

ServerTally Cluster::tally() const {
  const std::lock_guard lock(mutex_);
  return tally_;
}

void Cluster::supersede(uint32_t firstWanted) {
  loop_.post([this, firstWanted] { server_.supersede(firstWanted, Clock::now()); });
}

void Cluster::cancelSteps(uint32_t firstWanted) {
  loop_.post([this, firstWanted] { server_.cancelSteps(firstWanted, Clock::now()); });
}

void Cluster::mark(uint32_t frame) {
  loop_.post([this, frame] { server_.mark(frame); });
}

void Cluster::keepStates(uint32_t from) {
  loop_.post([this, from] { server_.keepStates(from); });
}

void Cluster::wake() {
  loop_.post([this] { server_.tick(Clock::now()); });
}

void Cluster::decoded(ReceivedTile&& tile, const std::optional<std::string>& malformed) {
  {
    const std::lock_guard lock(mutex_);
    decoded_.push_back({std::move(tile), malformed});
    if (decoded_.size() > 1) return;  // the loop has been told
  }
  loop_.post([this] {
    std::vector<Decoded> all;
    {
      const std::lock_guard lock(mutex_);
      all.swap(decoded_);
    }
    const Time now = Clock::now();
    for (const Decoded& d : all) server_.decoded(d.tile, d.malformed, now);
  });
}

void Cluster::stop(const std::string& reason) {
  loop_.post([this, reason] {
    if (endBy_) return;
    const Time now = Clock::now();
    endBy_ = now + kTimeToEnd;
    server_.close(reason);
    local_.stop(now);
    hosts_.stop(now);
  });
}

void Cluster::join() {
  if (thread_.joinable()) thread_.join();
}

}  // namespace ninefold
