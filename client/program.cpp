#include "client/program.h"

#include <signal.h>
#include <unistd.h>

#include <functional>

#include "common/base/log.h"
#include "common/base/process.h"

namespace ninefold::client {
namespace {

constexpr Duration kTick = milliseconds(100);
constexpr size_t kEarly = 1024;          // messages with tasks that wait for their job
constexpr size_t kTasksPerThread = 256;  // twice what the scheduler may ever have out, and some

Time now() { return Clock::now(); }

SessionOptions sessionOptions(const Options& options, msg::Hello hello) {
  SessionOptions session;
  session.seed = std::hash<std::string>()(hello.name) ^
                 static_cast<uint64_t>(now().time_since_epoch().count());
  session.hello = std::move(hello);
  session.master = options.masterFile ? options.masterFile->string() : options.master;
  session.reconnect = !options.local();
  return session;
}

uint32_t jobOf(const std::variant<act::StartTasks, act::StartSteps>& start) {
  const auto* tasks = std::get_if<act::StartTasks>(&start);
  return tasks != nullptr ? tasks->tasks.jobVersion
                          : std::get<act::StartSteps>(start).steps.jobVersion;
}

MasterAddress addressOf(const Options& options) {
  return options.masterFile ? MasterAddress(*options.masterFile)
                            : MasterAddress(parseEndpoint(options.master, "--master"));
}

bool isFinal(ConnectProblem problem) {
  return problem == ConnectProblem::wrongKey || problem == ConnectProblem::notNinefold;
}

// No destructors: a thread is where it does not come back from.
[[noreturn]] void endHung(const std::string& task, Duration time) {
  warn("this client ends: not done after {:.0f} s is {}", seconds(time), task);
  ::_exit(kHungStatus);
}

}  // namespace

Program::Program(EventLoop& loop, const Options& options, msg::Hello hello,
                 std::shared_ptr<const Key> key, std::optional<BlobCache> cache, Rig rig)
    : loop_(loop),
      master_(addressOf(options)),
      local_(options.local()),
      key_(std::move(key)),
      recorder_(options.record ? std::make_unique<Recorder>(*options.record, hello) : nullptr),
      session_(sessionOptions(options, std::move(hello)), now()),
      threads_(options.threads),
      rig_(std::move(rig)),
      watchdog_(options.threads, rig_.grace, endHung),
      builder_(std::move(cache), options.isa, options.threads, answers()),
      workers_(options.threads, kTasksPerThread * static_cast<size_t>(options.threads)) {
  loop_.onSignal(endingSignals(), [this](int signal) {
    // What happens to the master's terminal reaches its local clients too, but is the master's to
    // handle.
    if (local_ && signal != SIGTERM) return;
    session_.stop("stopped by a signal");
    carryOut();
  });
}

int Program::run() {
  tick();
  loop_.run();
  keepRecording();
  return status_;
}

void Program::keepRecording() {
  try {
    if (recorder_) recorder_->finish();
  } catch (const Error& error) {
    log("{}", error.what());
    status_ = 1;
  }
}

void Program::tick() {
  session_.tick(now());
  carryOut();
  if (!ending_) timer_ = loop_.after(kTick, [this] { tick(); });
}

template <typename Event>
void Program::later(Event event) {
  loop_.post([this, event = std::move(event)]() mutable {
    event();
    carryOut();
  });
}

SceneBuilder::Answers Program::answers() {
  SceneBuilder::Answers answers;
  answers.found = [this](uint32_t load, std::vector<BlobInfo> missing) {
    later([this, load, missing = std::move(missing)]() mutable {
      session_.blobsFound(load, std::move(missing), now());
    });
  };
  answers.built = [this](uint32_t load) {
    later([this, load] { session_.sceneBuilt(load, now()); });
  };
  answers.prepared = [this](const act::PrepareJob& asked, std::shared_ptr<RenderJob> job) {
    later([this, load = asked.load, line = asked.line, version = asked.jobVersion,
           job = std::move(job)] {
      if (!session_.jobPrepared(load, line, version, now())) return;
      jobs_[version] = job;
      while (jobs_.size() > kJobsKept) jobs_.erase(jobs_.begin());
      startEarly();
    });
  };
  answers.failed = [this](uint32_t load, std::string line) {
    later([this, load, line = std::move(line)] { session_.sceneFailed(load, line, now()); });
  };
  return answers;
}

void Program::carryOut() {
  for (auto actions = session_.takeActions(); !actions.empty(); actions = session_.takeActions())
    for (act::Action& action : actions) std::visit([this](auto& a) { on(std::move(a)); }, action);
}

void Program::on(act::Connect&&) {
  Endpoint master;
  try {
    master = master_.next();
  } catch (const Error& error) {
    return session_.connectFailed(error.what(), false, now());
  }
  connect(
      loop_, master, local_ ? KeyUse::local : KeyUse::cluster, key_,
      [this](std::shared_ptr<Connection> connection) { startConnection(std::move(connection)); },
      [this](const ConnectFailure& failure) {
        session_.connectFailed(failure.line, isFinal(failure.problem), now());
        carryOut();
      });
}

void Program::startConnection(std::shared_ptr<Connection> connection) {
  connection_ = std::move(connection);
  const Connection* ours = connection_.get();
  Connection::Events events;
  events.onMessage = [this, ours](Message&& message) {
    if (connection_.get() != ours) return;
    if (keep(message)) session_.received(std::move(message), now());
    carryOut();
  };
  events.onClosed = [this, ours](const std::string& reason) {
    if (connection_.get() != ours) return;
    connection_.reset();
    if (ending_) return loop_.stop();
    session_.disconnected(reason, now());
    carryOut();
  };
  connection_->start(std::move(events));
  session_.connected(now());
  carryOut();
}

// Into the recording, if there is one. A failure is ours: the connection would take it for a bad
// message, and the client would try again for ever.
bool Program::keep(const Message& message) {
  try {
    if (recorder_) recorder_->heard(message);
    return true;
  } catch (const Error& error) {
    session_.recordingFailed(error.what());
    return false;
  }
}

void Program::on(act::Send&& action) {
  if (connection_) connection_->send(std::move(action.message));
}

void Program::on(act::Disconnect&& action) {
  if (const auto connection = std::exchange(connection_, nullptr))
    connection->finish(action.reason);
}

void Program::startInTurn(Start&& start) {
  early_.push_back(std::move(start));
  if (early_.size() > kEarly) return session_.tasksRefused(now());
  startEarly();
}

// In their order, as far as their jobs are there.
void Program::startEarly() {
  while (!early_.empty()) {
    const auto job = jobs_.find(jobOf(early_.front()));
    if (job == jobs_.end()) return;
    const bool hadRoom =
        std::visit([&](const auto& first) { return start(first, job->second); }, early_.front());
    early_.pop_front();
    if (!hadRoom) return session_.tasksRefused(now());
  }
}

bool Program::start(const act::StartTasks& action, const std::shared_ptr<RenderJob>& job) {
  const msg::Tasks& tasks = action.tasks;
  const Order order{action.line,           tasks.frame,  action.state,
                    tasks.neighbourWeight, tasks.urgent, tasks.allowed};
  for (const msg::TaskItem& item : tasks.items) {
    const auto work = [this, job, order, item](int thread) { runTask(*job, order, item, thread); };
    if (!workers_.start(order.frame.frame, work)) return false;
  }
  return true;
}

bool Program::start(const act::StartSteps& action, const std::shared_ptr<RenderJob>& job) {
  const auto steps = std::make_shared<const act::StartSteps>(action);
  for (const uint32_t unit : steps->steps.units) {
    const auto work = [this, job, steps, unit](int thread) { runUnit(*job, *steps, unit, thread); };
    if (!workers_.start(steps->steps.step.number, work, true)) return false;
  }
  return true;
}

// On a worker's thread.
void Program::runUnit(const RenderJob& job, const act::StartSteps& action, uint32_t unit,
                      int thread) {
  const msg::Steps& steps = action.steps;
  const auto describe = [&] { return fmt::format("step {}, unit {}", steps.step.number, unit); };
  watchdog_.begin(thread, steps.allowed, describe);
  try {
    msg::Stepped done = job.step(steps.step, unit, *action.state, now);
    if (rig_.afterUnit) rig_.afterUnit(done);
    watchdog_.end(thread);
    if (recorder_) recorder_->add(done);
    add({action.line, false, std::move(done)});
  } catch (const std::exception& error) {
    watchdog_.end(thread);
    later([this, line = fmt::format("{}: {}", describe(), error.what())] {
      session_.taskFailed(line);
    });
  }
}

// On a worker's thread.
void Program::runTask(RenderJob& job, const Order& order, const msg::TaskItem& item, int thread) {
  watchdog_.begin(thread, order.allowed, [&] { return job.describe(order.frame, item); });
  try {
    if (rig_.beforeTask) rig_.beforeTask(order.frame, item);
    RenderJob::Done done =
        job.run(order.frame, item, order.neighbourWeight, level_, thread, now, *order.state);
    if (rig_.afterTask) rig_.afterTask(done.result);
    watchdog_.end(thread);
    if (recorder_) recorder_->add(done.result);
    add({order.line, order.urgent, std::move(done)});
  } catch (const std::exception& error) {  // no memory, most likely
    watchdog_.end(thread);
    later([this, line = fmt::format("frame {}, tile {}, phase {}: {}", order.frame.frame, item.tile,
                                    item.phase, error.what())] { session_.taskFailed(line); });
  }
}

// On a worker's thread.
void Program::add(ResultGroup::Finished&& finished) {
  const auto next = [this] { return workers_.nextFrame(); };
  if (results_.add(std::move(finished), next, now())) later([this] { handOver(); });
}

void Program::handOver() {
  for (ResultGroup::Finished& finished : results_.take(now())) {
    if (auto* unit = std::get_if<msg::Stepped>(&finished.done)) {
      session_.unitFinished(finished.line, std::move(*unit));
      continue;
    }
    auto& task = std::get<RenderJob::Done>(finished.done);
    wireLevel_.finished(task.rawBytes, finished.busy());
    session_.taskFinished(finished.line, std::move(task.result), now());
  }
  if (connection_) level_ = wireLevel_.choose(connection_->lineRate(), threads_);
}

void Program::on(act::CancelTasks&& action) {
  const auto isVoid = [&](uint32_t frame, bool isStep) {
    return action.everything || (!isStep && frame < action.frame);
  };
  drop(isVoid);
  if (action.everything) jobs_.clear();  // another connection counts anew
}

void Program::on(act::CancelUnits&& action) {
  drop([&](uint32_t number, bool isStep) { return isStep && number < action.number; });
}

void Program::drop(const std::function<bool(uint32_t number, bool isStep)>& isVoid) {
  workers_.cancel(isVoid);
  handOver();  // what waits for the end of a task that is gone
  std::erase_if(early_, [&](const Start& start) {
    const auto* tasks = std::get_if<act::StartTasks>(&start);
    return tasks != nullptr ? isVoid(tasks->tasks.frame.frame, false)
                            : isVoid(std::get<act::StartSteps>(start).steps.step.number, true);
  });
}

void Program::on(act::Tell&& action) {
  if (!local_) log("{}", action.line);
}

void Program::on(act::Exit&& action) {
  ending_ = true;
  status_ = action.status;
  timer_.reset();
  if (status_ != 0 || !local_) log("{}", action.line);
  if (connection_)
    connection_->finish(action.line);
  else
    loop_.stop();
}

}  // namespace ninefold::client
