// ninefold-replay-client --master ADDR:PORT --key-file FILE --recording FILE [options]: clients
// that trace nothing. They answer each task with the result that a real client gave (its --record).
//
// They load the master and the network as real clients do, at any number, without a core for each.
// With --pace recorded an answer takes the recorded time; the first task of each light set of a
// frame takes longer, by what light sets took in the mean. --slower F makes all times F times as
// long, so that the clients leave the machine to the master. Recorded frames repeat. A frame
// answers tasks that ask for the planes that it has. So a session needs the recording of a session.
// One thread serves all. Exit status: 0 the master is done, 1 a failure, 2 wrong usage.

#include <map>
#include <set>
#include <tuple>

#include "common/sampling/interleave.h"
#include "proto/connection.h"
#include "proto/recording.h"
#include "tools/command.h"

namespace ninefold {
namespace {

namespace po = boost::program_options;

struct Options {
  std::string master, keyFile, recording, pace = "full";
  int clients = 1, threads = 1;
  double slower = 1;
};

using TaskPlace = std::tuple<uint32_t, uint32_t, uint8_t>;  // tile, phase, its ExtraPlanes

// What was recorded, frame by frame.
class Recorded {
 public:
  explicit Recorded(const std::string& file) {
    for (Message& message : readRecording(file)) {
      if (const auto* tasks = std::get_if<msg::Tasks>(&message)) note(*tasks);
      if (auto* result = std::get_if<msg::Result>(&message)) add(std::move(*result));
    }
    if (frames_.empty()) fail("recording {}: holds no result", file);
    measureSets();
  }

  // The result for a task, as if it had just been made; null if none was recorded.
  const msg::Result* find(uint32_t frame, const msg::TaskItem& item) const {
    for (size_t tried = 0; tried < frames_.size(); ++tried) {  // the last frame may be incomplete
      const auto& results = frames_[(frame + tried) % frames_.size()];
      const auto found = results.find({item.tile, item.phase, item.extraMask});
      if (found != results.end()) return &found->second;
    }
    return nullptr;
  }
  Duration work(const msg::Result& r) const {
    const std::chrono::nanoseconds all(r.busyNs);
    return std::max(Duration{0}, Duration(all) - (r.setsMade > 0 ? setTime_ : Duration{0}));
  }
  Duration setTime() const { return setTime_; }

 private:
  void note(const msg::Tasks& tasks) {
    for (const msg::TaskItem& item : tasks.items)
      planes_[{tasks.frame.frame, item.tile, item.phase}] = item.extraMask;
  }
  void add(msg::Result&& result) {
    const uint8_t planes = planes_[{result.frame, result.tile, result.phase}];
    const size_t number = numbers_.emplace(result.frame, numbers_.size()).first->second;
    if (number == frames_.size()) frames_.emplace_back();
    frames_[number].emplace(TaskPlace(result.tile, result.phase, planes), std::move(result));
  }
  // Mean time of tasks that made their light set, less that of those which found it made.
  void measureSets() {
    std::array<double, 2> sum{}, count{};
    for (const auto& results : frames_)
      for (const auto& [place, r] : results) {
        sum[r.setsMade > 0 ? 1 : 0] += static_cast<double>(r.busyNs);
        count[r.setsMade > 0 ? 1 : 0] += 1;
      }
    if (count[0] == 0 || count[1] == 0) return;
    const double ns = sum[1] / count[1] - sum[0] / count[0];
    setTime_ = std::chrono::nanoseconds(static_cast<int64_t>(std::max(0.0, ns)));
  }

  std::vector<std::map<TaskPlace, msg::Result>> frames_;
  std::map<uint32_t, size_t> numbers_;                                  // in frames_, of a frame
  std::map<std::tuple<uint32_t, uint32_t, uint32_t>, uint8_t> planes_;  // of frame, tile, phase
  Duration setTime_{0};
};

// One client: answers tasks in their order, as many at once as it has threads.
class ReplayClient {
 public:
  enum class Ending : uint8_t { lost, done, failed };
  using OnEnd = std::function<void(Ending ending, const std::string& reason)>;

  ReplayClient(EventLoop& loop, const Options& options, const Recorded& recorded, int number,
               OnEnd onEnd)
      : loop_(loop),
        recorded_(recorded),
        paced_(options.pace == "recorded"),
        slower_(options.slower),
        number_(number),
        onEnd_(std::move(onEnd)),
        freeAt_(static_cast<size_t>(options.threads), Time{}) {}

  void start(std::shared_ptr<Connection> connection) {
    connection_ = std::move(connection);
    Connection::Events events;
    events.onMessage = [this](Message&& message) {
      std::visit([this](auto& m) { on(m); }, message);
    };
    events.onClosed = [this](const std::string& reason) {
      onEnd_(ending_, failure_.empty() ? reason : failure_);
    };
    connection_->start(std::move(events));
    msg::Hello hello;
    hello.name = fmt::format("replay {}", number_);
    hello.threads = static_cast<uint32_t>(freeAt_.size());
    hello.isa = "replay";
    connection_->send(hello);
  }

 private:
  struct Answer {
    msg::Result result;
    bool urgent;
  };

  void on(msg::Configure& m) {
    job_ = m.jobVersion;
    sets_ = m.settings.interleave.sets();
    connection_->send(msg::Ready{m.sceneVersion, m.jobVersion});
  }
  void on(msg::Ping& m) { connection_->send(msg::Pong{m.clockNs, 0}); }
  void on(msg::Refuse& m) { stop("the master refused: " + m.reason); }
  void on(msg::Goodbye&) { ending_ = Ending::done; }
  void on(msg::Cancel& m) {
    std::erase_if(waiting_, [&](const auto& a) { return a.second.result.frame < m.frame; });
  }
  void on(msg::Tasks& m) {
    for (const msg::TaskItem& item : m.items) take(m.frame, item, m.urgent);
    answerDue();
  }
  void on(msg::Steps&) {
    stop("the master's method has a state, whose steps no recording can answer; choose another");
  }
  template <typename Other>
  void on(Other&) {}

  void stop(std::string why) {
    ending_ = Ending::failed;
    failure_ = why;
    connection_->close(std::move(why));
  }
  void take(const FrameKey& frame, const msg::TaskItem& item, bool urgent) {
    const msg::Result* recorded = recorded_.find(frame.frame, item);
    if (recorded == nullptr)
      return stop(
          fmt::format("no result for tile {}, phase {}, planes {:#x}: recorded of another picture?",
                      item.tile, item.phase, item.extraMask));
    msg::Result result = *recorded;
    result.jobVersion = job_, result.frame = frame.frame;
    const int set = lightSetOfPhase(static_cast<int>(item.phase), frame.rotation, sets_);
    const bool newSet = made_.emplace(frame.randomization, set).second;
    if (made_.size() > 256) made_.erase(made_.begin());
    result.setsMade = newSet ? 1 : 0;
    const Duration whole = recorded_.work(*recorded) + (newSet ? recorded_.setTime() : Duration{0});
    const auto cost = std::chrono::duration_cast<Duration>(slower_ * whole);
    result.busyNs = static_cast<uint64_t>(std::chrono::nanoseconds(cost).count());
    if (!paced_) {
      connection_->send(std::move(result));
      return;
    }
    Time& worker = *std::ranges::min_element(freeAt_);
    worker = std::max(worker, Clock::now()) + cost;
    waiting_.emplace(worker, Answer{std::move(result), urgent});
  }

  void answerDue() {
    while (!waiting_.empty() && waiting_.begin()->first <= Clock::now()) {
      connection_->send(std::move(waiting_.begin()->second.result));
      waiting_.erase(waiting_.begin());
      answered_ = Clock::now();
    }
    if (waiting_.empty()) return;
    timer_ = loop_.after(nextGroup() - Clock::now(), [this] { answerDue(); });
  }

  // In groups, like those of client/result_group.h.
  Time nextGroup() const {
    const auto& [due, first] = *waiting_.begin();
    if (first.urgent) return due;
    Time last = due;  // of its frame
    for (const auto& [time, answer] : waiting_)
      if (answer.result.frame == first.result.frame) last = time;
    return std::max(due, std::min(answered_ + kResultsTogether, last));
  }

  EventLoop& loop_;
  const Recorded& recorded_;
  const bool paced_;
  const double slower_;
  const int number_;
  const OnEnd onEnd_;
  std::shared_ptr<Connection> connection_;
  uint32_t job_ = 0;
  int sets_ = 1;
  std::vector<Time> freeAt_;             // by thread
  std::multimap<Time, Answer> waiting_;  // by when they are due
  Time answered_{};
  std::set<std::pair<uint32_t, int>> made_;  // light sets, by randomization
  std::unique_ptr<EventLoop::Timer> timer_;
  Ending ending_ = Ending::lost;
  std::string failure_;
};

// All of them in one loop. A lost connection is dialled again; ends when the master is done.
class Replay {
 public:
  Replay(const Options& options)
      : options_(options),
        recorded_(options.recording),
        key_(std::make_shared<const Key>(Key::load(options.keyFile))),
        clients_(static_cast<size_t>(options.clients)),
        retries_(clients_.size()),
        left_(options.clients) {}

  int run() {
    for (size_t i = 0; i < clients_.size(); ++i) dial(i);
    loop_.run();
    if (failure_.empty()) return 0;
    fail("{}", failure_);
  }

 private:
  using Ending = ReplayClient::Ending;

  void dial(size_t i) {
    ConnectionOptions line;
    line.silence = std::chrono::seconds(10);  // as real clients
    connect(
        loop_, parseEndpoint(options_.master, "--master"), KeyUse::cluster, key_,
        [this, i](std::shared_ptr<Connection> connection) {
          joined_ = true;
          clients_[i] = std::make_unique<ReplayClient>(
              loop_, options_, recorded_, static_cast<int>(i) + 1,
              [this, i](Ending ending, const std::string& reason) { ended(i, ending, reason); });
          clients_[i]->start(std::move(connection));
        },
        [this, i](const ConnectFailure& failure) { notConnected(i, failure); }, line);
  }
  // A master that was there and is no more is done.
  void notConnected(size_t i, const ConnectFailure& failure) {
    const bool gone = failure.problem == ConnectProblem::refused;
    ended(i, !joined_ ? Ending::failed : gone ? Ending::done : Ending::lost, failure.line);
  }
  void ended(size_t i, Ending ending, const std::string& reason) {
    if (ending == Ending::lost) {
      retries_[i] = loop_.after(milliseconds(500), [this, i] { dial(i); });
      return;
    }
    if (ending == Ending::failed && failure_.empty()) failure_ = reason;
    if (--left_ == 0 || ending == Ending::failed) loop_.stop();
  }

  const Options& options_;
  const Recorded recorded_;
  const std::shared_ptr<const Key> key_;
  EventLoop loop_;
  std::vector<std::unique_ptr<ReplayClient>> clients_;
  std::vector<std::unique_ptr<EventLoop::Timer>> retries_;
  int left_;
  bool joined_ = false;
  std::string failure_;
};

int run(int argc, char** argv) {
  Options o;
  Command command{"ninefold-replay-client",
                  "--master ADDR:PORT --key-file FILE --recording FILE [options]",
                  "Clients that trace nothing: they answer with the results of a recording.\n"};
  command.flags.add_options()("master", po::value(&o.master), "ADDR:PORT")(
      "key-file", po::value(&o.keyFile), "the cluster key")(
      "recording", po::value(&o.recording), "FILE that ninefold-client --record made")(
      "clients", po::value(&o.clients), "how many, default 1")("threads", po::value(&o.threads),
                                                               "of each client, default 1")(
      "pace", po::value(&o.pace), "full: answer at once (default); recorded: as long as it took")(
      "slower", po::value(&o.slower), "with --pace recorded: times as long; default 1");
  if (!parseCommandLine(argc, argv, command)) return 0;
  for (const auto& [name, value] :
       {std::pair("--master", o.master), {"--key-file", o.keyFile}, {"--recording", o.recording}})
    if (value.empty()) failUsage("{} is missing", name);
  if (o.pace != "full" && o.pace != "recorded")
    failUsage("--pace {}: must be full or recorded", o.pace);
  checkRange("clients", o.clients, 1, 1024);
  checkRange("threads", o.threads, 1, 1024);
  checkRange("slower", o.slower, 1.0, 1000.0);
  return Replay(o).run();
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  return ninefold::runProgram("ninefold-replay-client", [&] { return ninefold::run(argc, argv); });
}
