// The server with real connections on one event loop; the clients are played by the test.
#include "master/serving/server.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

namespace ninefold {
namespace {

using std::chrono::seconds;

Settings smallPicture() {
  Settings s;
  s.width = 96, s.height = 72;
  return s;
}

std::vector<Blob> anyScene() { return packScene(Scene()); }

// Introduces itself, claims to be ready, and answers tasks as it is told.
class PlayedClient {
 public:
  using OnTasks = std::function<void(PlayedClient&, const msg::Tasks&)>;

  PlayedClient(EventLoop& loop, const Endpoint& master, std::shared_ptr<const Key> key,
               OnTasks onTasks)
      : onTasks_(std::move(onTasks)) {
    connect(
        loop, master, KeyUse::local, std::move(key),
        [this](std::shared_ptr<Connection> connection) { begin(std::move(connection)); },
        [](const ConnectFailure& failure) { ADD_FAILURE() << failure.line; });
  }
  void answer(const msg::Tasks& tasks, size_t index) {
    msg::Result result;
    result.jobVersion = tasks.jobVersion;
    result.frame = tasks.frame.frame;
    result.tile = tasks.items[index].tile;
    result.phase = tasks.items[index].phase;
    result.busyNs = 1000;
    connection_->send(std::move(result));
  }
  void answerAll(const msg::Tasks& tasks) {
    for (size_t i = 0; i < tasks.items.size(); ++i) answer(tasks, i);
  }
  void send(Message message) { connection_->send(std::move(message)); }

  bool closed = false;
  uint32_t announced = 0;  // the latest job
  std::string refusal;

 private:
  void begin(std::shared_ptr<Connection> connection) {
    connection_ = std::move(connection);
    Connection::Events events;
    events.onMessage = [this](Message&& message) { receive(message); };
    events.onClosed = [this](const std::string&) { closed = true; };
    connection_->start(std::move(events));
    msg::Hello hello;
    hello.name = "played", hello.isa = "avx2", hello.probeClass = "aaaa";
    connection_->send(std::move(hello));
  }
  void receive(const Message& message) {
    if (const auto* m = std::get_if<msg::Configure>(&message)) {
      announced = m->jobVersion;
      connection_->send(msg::Ready{m->sceneVersion, m->jobVersion});
    }
    if (const auto* m = std::get_if<msg::Tasks>(&message)) onTasks_(*this, *m);
    if (const auto* m = std::get_if<msg::Refuse>(&message)) refusal = m->reason;
  }

  const OnTasks onTasks_;
  std::shared_ptr<Connection> connection_;
};

class ServerTest : public testing::Test {
 protected:
  ServerTest() {
    ServerDuty duty;
    duty.nextWork = [this]() -> std::optional<FrameOrder> {
      if (opened == frames) return std::nullopt;
      FrameOrder order;
      order.settings = smallPicture();
      order.job = jobOf(opened);
      order.urgent = opened >= firstUrgent;
      order.key.frame = opened++;
      return order;
    };
    duty.take = [this](ReceivedTile& tile) {  // "decodes" later, as an assembly would
      if (!hasRoom) return false;
      loop.post([this, tile] { server->decoded(tile, judge(tile), Clock::now()); });
      return true;
    };
    duty.giveUp = [this] {  // one more frame takes their place
      frames = opened + 1;
      return givenUp = opened;
    };
    const ServerSetup setup{{"127.0.0.1", 0}, {key, nullptr}, 1};
    server = std::make_unique<Server>(loop, setup, offer, std::move(duty));
  }
  ~ServerTest() override {
    server->close("the test is over");
    until([this] {
      return !server->isConnected() &&
             std::ranges::all_of(played, [](auto& c) { return c->closed; });
    });
  }

  PlayedClient& play(PlayedClient::OnTasks onTasks) {
    played.push_back(
        std::make_unique<PlayedClient>(loop, server->endpoint(), key, std::move(onTasks)));
    return *played.back();
  }
  // Runs the loop until the condition has held once; the deadline only ends a broken test.
  void until(const std::function<bool()>& condition) {
    const Time end = Clock::now() + seconds(30);
    std::unique_ptr<EventLoop::Timer> timer;
    bool held = false;
    const auto isOver = [&] {
      server->tick(Clock::now());
      held = condition();
      return held || Clock::now() > end;
    };
    const std::function<void()> look = [&] {
      if (isOver()) return loop.stop();
      timer = loop.after(milliseconds(2), look);
    };
    if (!isOver()) {  // a loop that does not run must not be stopped: it would remember
      timer = loop.after(milliseconds(2), look);
      loop.run();
    }
    EXPECT_TRUE(held);
  }

  EventLoop loop;
  const std::shared_ptr<const Key> key = std::make_shared<const Key>(Key::random());
  const TileGrid grid{96, 72, {3, 3}};
  JobOffer offer{anyScene(), smallPicture(), {}};
  std::function<uint32_t(uint32_t frame)> jobOf = [](uint32_t) { return 1u; };
  std::function<std::optional<std::string>(const ReceivedTile&)> judge = [](const ReceivedTile&) {
    return std::nullopt;
  };
  uint32_t frames = 3, opened = 0, firstUrgent = ~0u, givenUp = 0;
  bool hasRoom = true;
  std::unique_ptr<Server> server;
  std::vector<std::unique_ptr<PlayedClient>> played;
};

TEST_F(ServerTest, RendersAllFramesWithWhoeverIsThere) {
  play([](PlayedClient& c, const msg::Tasks& tasks) { c.answerAll(tasks); });
  until([this] { return server->tally().tasks.completedFrames == frames; });
  const ServerTally tally = server->tally();
  EXPECT_TRUE(tally.firstDispatch && tally.lastCompletion);
  EXPECT_GT(tally.bytesReceived, 0u);
  ASSERT_EQ(server->clients(Clock::now()).size(), 1u);
  EXPECT_EQ(server->clients(Clock::now())[0].name, "played");
}

TEST_F(ServerTest, AMalformedResultIsCountedItsSenderExpelledAndTheWorkDoneByAnother) {
  judge = [](const ReceivedTile& tile) {
    return tile.client == 1 ? std::optional<std::string>("tile 0 cannot be decoded") : std::nullopt;
  };
  PlayedClient& bad = play([](PlayedClient& c, const msg::Tasks& tasks) { c.answerAll(tasks); });
  until([&] { return bad.closed; });
  EXPECT_NE(bad.refusal.find("cannot be decoded"), std::string::npos);
  EXPECT_EQ(server->tally().tasks.completedFrames, 0u);
  play([](PlayedClient& c, const msg::Tasks& tasks) { c.answerAll(tasks); });
  until([this] { return server->tally().tasks.completedFrames == frames; });
  EXPECT_GE(server->tally().malformed, 1u);
  EXPECT_GE(server->tally().tasks.reissued, 1u);
}

// It says nothing more, so that nothing else would remind the master of it.
TEST_F(ServerTest, WhoIsExpelledWhileItsResultIsTakenIsToldAtOnce) {
  hasRoom = false;
  bool answered = false;
  PlayedClient& bad = play([&](PlayedClient& c, const msg::Tasks& tasks) {
    if (!std::exchange(answered, true)) c.answer(tasks, 0);
  });
  until([&] { return bad.closed; });
  EXPECT_NE(bad.refusal.find("more results than were asked for"), std::string::npos);
  hasRoom = true;
  play([](PlayedClient& c, const msg::Tasks& tasks) { c.answerAll(tasks); });
  until([this] { return server->tally().tasks.completedFrames == frames; });
}

TEST_F(ServerTest, AClientThatLeavesInTheMiddleIsReplacedAtOnce) {
  PlayedClient& leaving = play([](PlayedClient& c, const msg::Tasks& tasks) {
    c.answer(tasks, 0);
    c.send(msg::Goodbye{"enough"});
  });
  until([&] { return leaving.closed; });
  play([](PlayedClient& c, const msg::Tasks& tasks) { c.answerAll(tasks); });
  until([this] { return server->tally().tasks.completedFrames == frames; });
}

TEST_F(ServerTest, ResultsThatNobodyAskedForAreDroppedAndCounted) {
  play([](PlayedClient& c, const msg::Tasks& tasks) {
    c.answerAll(tasks);
    c.answerAll(tasks);  // once more
    msg::Tasks wild = tasks;
    wild.frame.frame = 999;
    c.answer(wild, 0);
    wild.frame.frame = 0, wild.items[0].tile = 1 << 30;
    c.answer(wild, 0);
  });
  until([this] { return server->tally().tasks.completedFrames == frames; });
  const SchedulerCounts& tasks = server->tally().tasks;
  EXPECT_GE(tasks.droppedUnknown + tasks.droppedDuplicate + tasks.droppedStale, 2u);
}

TEST_F(ServerTest, AnnouncesEachJobBeforeItsFirstTasks) {
  jobOf = [](uint32_t frame) { return 1 + frame; };
  std::vector<uint32_t> seen;
  play([&](PlayedClient& c, const msg::Tasks& tasks) {
    EXPECT_EQ(tasks.jobVersion, 1 + tasks.frame.frame);
    EXPECT_GE(c.announced, tasks.jobVersion);
    seen.push_back(tasks.jobVersion);
    c.answerAll(tasks);
  });
  until([this] { return server->tally().tasks.completedFrames == frames; });
  EXPECT_EQ(seen.back(), frames);
}

TEST_F(ServerTest, TellsClientsWhichTasksAreUrgent) {
  firstUrgent = 1;
  std::set<uint32_t> seen;
  play([&](PlayedClient& c, const msg::Tasks& tasks) {
    EXPECT_EQ(tasks.urgent, tasks.frame.frame >= firstUrgent);
    seen.insert(tasks.frame.frame);
    c.answerAll(tasks);
  });
  until([this] { return server->tally().tasks.completedFrames == frames; });
  EXPECT_EQ(seen.size(), frames);
}

// The first client keeps the old frame open by one task, and all of the new one.
TEST_F(ServerTest, AClientThatComesLateGetsNoTaskOfAJobThatItMissed) {
  frames = 2;
  jobOf = [](uint32_t frame) { return 1 + frame; };
  std::optional<msg::Tasks> last;
  std::vector<msg::Tasks> later;
  PlayedClient& first = play([&](PlayedClient& c, const msg::Tasks& tasks) {
    if (tasks.jobVersion == 2) return later.push_back(tasks);
    for (size_t i = last ? 0 : 1; i < tasks.items.size(); ++i) c.answer(tasks, i);
    if (!last) last = tasks;
  });
  until([&] { return !later.empty(); });
  bool late = false;
  play([&](PlayedClient& c, const msg::Tasks& tasks) {
    EXPECT_EQ(tasks.jobVersion, 2u);
    late = true;
    c.answerAll(tasks);
  });
  until([&] {
    const auto clients = server->clients(Clock::now());
    return clients.size() == 2 && clients[1].status.state == ClientState::ready;
  });
  EXPECT_FALSE(late);
  first.answer(*last, 0);
  // The second one may be done as soon: who came late makes copies of what the first client sits
  // on.
  until([&] { return server->tally().tasks.completedFrames >= 1; });
  for (const msg::Tasks& tasks : later) first.answerAll(tasks);
  until([this] { return server->tally().tasks.completedFrames == frames; });
}

// Two frames of two jobs are open when the only client leaves: who comes now can do neither.
TEST_F(ServerTest, FramesThatNobodyCanDoAnyMoreAreGivenUp) {
  jobOf = [](uint32_t frame) { return std::min(frame, 1u) + 1; };
  frames = 2;
  bool both = false, kept = false;
  PlayedClient& first = play([&](PlayedClient& c, const msg::Tasks& tasks) {
    both = both || tasks.jobVersion == 2;
    for (size_t i = std::exchange(kept, true) ? 0 : 1; i < tasks.items.size() && !both; ++i)
      c.answer(tasks, i);
  });
  until([&] { return both; });
  first.send(msg::Goodbye{"enough"});
  play([](PlayedClient& c, const msg::Tasks& tasks) {
    EXPECT_EQ(tasks.frame.frame, 2u);
    c.answerAll(tasks);
  });
  until([this] { return server->tally().tasks.completedFrames == 1; });
  EXPECT_EQ(givenUp, 2u);
  EXPECT_EQ(server->tally().tasks.cancelledFrames, 2u);
}

TEST_F(ServerTest, CountsAndTellsOfValuesThatAreNotFinite) {
  bool first = true;
  testing::internal::CaptureStderr();
  play([&](PlayedClient& c, const msg::Tasks& tasks) {
    for (const msg::TaskItem& item : tasks.items) {
      msg::Result result;
      result.jobVersion = tasks.jobVersion, result.frame = tasks.frame.frame;
      result.tile = item.tile, result.phase = item.phase, result.busyNs = 1000;
      result.replaced = 2;
      result.replacedIn =
          std::exchange(first, false) ? 1 << 1 | 1 << 8 : 1 << 1;  // bits: tile_names.h
      c.send(std::move(result));
    }
  });
  until([this] { return server->tally().tasks.completedFrames == frames; });
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(server->tally().replaced, 2u * 3 * 9) << "96 x 72 pixels are one tile of nine phases";
  EXPECT_NE(text.find("frame 0, tile 0, phase 0 of client 1"), std::string::npos) << text;
  EXPECT_NE(text.find("2 values are not finite or negative, in E (diffuse), U (reflection)"),
            std::string::npos)
      << text;
  const std::string word = "are not finite";
  int lines = 0;
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++lines;
  EXPECT_EQ(lines, 2) << "the first and the tenth of 27 tiles";
}

TEST_F(ServerTest, SaysGoodbyeWhenItCloses) {
  PlayedClient& client = play([](PlayedClient& c, const msg::Tasks& tasks) { c.answerAll(tasks); });
  until([this] { return server->tally().tasks.completedFrames == frames; });
  server->close("done");
  until([&] { return client.closed && !server->isConnected(); });
}

}  // namespace
}  // namespace ninefold
