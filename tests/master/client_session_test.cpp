#include "master/serving/client_session.h"

#include <gtest/gtest.h>

#include "proto/scene_blobs.h"
#include "proto/state_wire.h"

namespace ninefold {
namespace {

using std::chrono::seconds;

std::vector<Blob> someBlobs() {
  Scene scene;
  scene.meshes.resize(1);
  scene.meshes[0].positions.resize(100000);  // of several pieces
  for (size_t i = 0; i < scene.meshes[0].positions.size(); ++i)
    scene.meshes[0].positions[i] = Vec3(static_cast<float>(i * 2654435761u % 1000003), 1, 2);
  return packScene(scene);
}

msg::Hello hello(const std::string& probe = "aaaa") {
  msg::Hello h;
  h.name = "pc2", h.threads = 4, h.isa = "avx2", h.probeClass = probe;
  return h;
}

constexpr uint32_t kJob = 1;

class ClientSessionTest : public testing::Test {
 protected:
  ClientSession session() { return {++ids, "10.0.0.2:5555", offer, state, admission, now}; }

  template <typename A>
  static std::vector<A> take(const std::vector<todo::Action>& actions) {
    std::vector<A> found;
    for (const todo::Action& action : actions)
      if (const A* a = std::get_if<A>(&action)) found.push_back(*a);
    return found;
  }
  template <typename M>
  static std::vector<M> sent(const std::vector<todo::Action>& actions) {
    std::vector<M> found;
    for (const todo::Send& send : take<todo::Send>(actions))
      if (const M* m = std::get_if<M>(&send.message)) found.push_back(*m);
    return found;
  }
  ClientSession ready() {
    ClientSession s = session();
    s.received(hello(), now);
    s.received(msg::Ready{JobOffer::kScene, kJob}, now);
    s.takeActions();
    return s;
  }
  void makeVersions(uint32_t last) {
    uint64_t hash = 0;
    for (uint32_t version = 1; version <= last; ++version) {
      state.open({.number = version, .from = version - 1, .to = version});
      msg::Stepped unit;
      unit.number = version, unit.stateHash = hash;
      unit.deltas = encodeDeltas({{{0, version}, Records(10, std::byte{1})}});
      state.take(std::move(unit));
      hash = state.complete(version).back().hash;
    }
  }

  std::vector<Blob> blobs = someBlobs();
  JobOffer offer{blobs, Settings(), {}};
  StateKeeper state;
  Admission admission;
  Time now = Time(std::chrono::hours(1));
  ClientId ids = 0;
};

TEST_F(ClientSessionTest, WelcomesAndOffersSceneAndSettings) {
  ClientSession s = session();
  s.received(hello(), now);
  auto actions = s.takeActions();
  ASSERT_EQ(sent<msg::Welcome>(actions).size(), 1u);
  EXPECT_EQ(s.hello().name, "pc2");
  const auto scene = sent<msg::SceneOffer>(actions);
  ASSERT_EQ(scene.size(), 1u);
  EXPECT_EQ(scene[0].blobs.size(), blobs.size());
  EXPECT_EQ(sent<msg::Configure>(actions).size(), 1u);
}

TEST_F(ClientSessionTest, OffersTheOldestStateThatIsNamedAndWhatCameSince) {
  makeVersions(3);
  state.forget(2);
  ClientSession s = session();
  s.received(hello(), now);
  auto actions = s.takeActions();
  const auto offer = sent<msg::StateOffer>(actions);
  ASSERT_EQ(offer.size(), 1u);
  EXPECT_EQ(offer[0].version, 2u);
  ASSERT_EQ(offer[0].pages.size(), 2u);
  const auto since = sent<msg::StateDelta>(actions);
  ASSERT_EQ(since.size(), 1u);
  EXPECT_EQ(since[0].to, 3u);
  const auto last = take<todo::Send>(actions).back();
  EXPECT_TRUE(std::holds_alternative<msg::Configure>(last.message)) << "work may follow it";
  s.received(msg::BlobRequest{offer[0].pages[1].blob.hash, 0}, now);
  EXPECT_EQ(sent<msg::BlobChunk>(s.takeActions()).size(), 1u);
}

TEST_F(ClientSessionTest, ALostClientKeepsNoVersion) {
  makeVersions(2);
  state.forget(1);
  ClientSession s = session();
  s.received(hello(), now);
  const std::weak_ptr<const StateKeeper::Snapshot> offered = state.snapshot();
  state.forget(2);  // the keeper's own is of another version now
  state.snapshot();
  ASSERT_FALSE(offered.expired());
  s.disconnected();
  EXPECT_TRUE(offered.expired());
}

TEST_F(ClientSessionTest, SendsBlobsPieceByPiece) {
  ClientSession s = session();
  s.received(hello(), now);
  s.takeActions();
  for (const Blob& blob : blobs) {
    Bytes got;
    while (got.size() < blob.compressed.size()) {
      s.received(msg::BlobRequest{blob.info.hash, got.size()}, now);
      auto actions = s.takeActions();
      const auto chunk = sent<msg::BlobChunk>(actions);
      ASSERT_EQ(chunk.size(), 1u);
      ASSERT_LE(chunk[0].bytes.size(), kBlobChunkBytes);
      EXPECT_EQ(chunk[0].total, blob.compressed.size());
      got.insert(got.end(), chunk[0].bytes.begin(), chunk[0].bytes.end());
    }
    EXPECT_EQ(got, blob.compressed);
  }
}

TEST_F(ClientSessionTest, ExpelsAClientThatAsksForWhatDoesNotExist) {
  for (const uint64_t offset : {uint64_t{0}, uint64_t{1} << 40}) {
    ClientSession s = session();
    s.received(hello(), now);
    s.takeActions();
    const Sha256 hash = offset == 0 ? Sha256{} : blobs[0].info.hash;
    s.received(msg::BlobRequest{hash, offset}, now);
    auto actions = s.takeActions();
    EXPECT_EQ(sent<msg::Refuse>(actions).size(), 1u);
    EXPECT_EQ(take<todo::Finish>(actions).size(), 1u);
    EXPECT_TRUE(s.over());
  }
}

TEST_F(ClientSessionTest, RefusesAnotherReleaseNamingBoth) {
  ClientSession s = session();
  msg::Hello old = hello();
  old.release = "0.0.1";
  s.received(Message(old), now);
  auto actions = s.takeActions();
  const auto refuse = sent<msg::Refuse>(actions);
  ASSERT_EQ(refuse.size(), 1u);
  EXPECT_NE(refuse[0].reason.find("0.0.1"), std::string::npos);
  EXPECT_NE(refuse[0].reason.find(releaseName()), std::string::npos);
  EXPECT_TRUE(s.over());
}

TEST_F(ClientSessionTest, LetsAnotherPixelClassInWithAWarning) {
  ClientSession first = session(), same = session(), other = session();
  first.received(hello("aaaa"), now);
  same.received(hello("aaaa"), now);
  auto calm = same.takeActions();
  EXPECT_TRUE(take<todo::Warn>(calm).empty());
  EXPECT_TRUE(admission.reproducible());
  other.received(hello("bbbb"), now);
  auto actions = other.takeActions();
  EXPECT_EQ(take<todo::Warn>(actions).size(), 1u);
  EXPECT_EQ(sent<msg::Welcome>(actions).size(), 1u);
  EXPECT_FALSE(admission.reproducible());
}

TEST_F(ClientSessionTest, AVisitorIsToldOfTheRunAndChangesNothing) {
  ClientSession first = session(), visitor = session(), early = session(), client = session();
  msg::Hello asks = hello("bbbb");
  asks.visits = true;
  early.received(Message(asks), now);
  EXPECT_EQ(sent<msg::Welcome>(early.takeActions())[0].probeClass, "") << "no client was there";
  first.received(hello("aaaa"), now);
  visitor.received(Message(asks), now);
  auto actions = visitor.takeActions();
  ASSERT_EQ(sent<msg::Welcome>(actions).size(), 1u);
  EXPECT_EQ(sent<msg::Welcome>(actions)[0].probeClass, "aaaa");
  EXPECT_EQ(sent<msg::SceneOffer>(actions).size(), 1u);
  EXPECT_TRUE(sent<msg::Configure>(actions).empty()) << "it gets no job";
  EXPECT_TRUE(take<todo::Warn>(actions).empty());
  EXPECT_TRUE(admission.reproducible());
  visitor.jobChanged({});
  EXPECT_TRUE(visitor.takeActions().empty());
  visitor.received(msg::Ready{JobOffer::kScene, kJob}, now);
  EXPECT_TRUE(visitor.over()) << "it cannot become a client";
}

TEST_F(ClientSessionTest, JoinsWhenReadyAndPassesResultsOn) {
  ClientSession s = session();
  s.received(hello(), now);
  s.received(msg::Ready{JobOffer::kScene, kJob}, now);
  auto actions = s.takeActions();
  EXPECT_EQ(take<todo::Join>(actions).size(), 1u);
  msg::Result result;
  result.jobVersion = kJob, result.tile = 3;
  s.received(std::move(result), now);
  actions = s.takeActions();
  const auto results = take<todo::TakeResult>(actions);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].result.tile, 3u);
  EXPECT_EQ(take<todo::Heard>(actions).size(), 1u);
}

TEST_F(ClientSessionTest, ExpelsWhoSendsThingsOutOfTurn) {
  const auto isExpelled = [&](Message message, bool afterHello) {
    ClientSession s = session();
    if (afterHello) s.received(hello(), now);
    s.received(std::move(message), now);
    return s.over();
  };
  EXPECT_TRUE(isExpelled(msg::Result{}, false));
  EXPECT_TRUE(isExpelled(msg::Result{}, true)) << "a result before Ready";
  EXPECT_TRUE(isExpelled(msg::Ready{JobOffer::kScene, kJob}, false));
  EXPECT_TRUE(isExpelled(msg::Ready{JobOffer::kScene + 1, kJob}, true));
  EXPECT_TRUE(isExpelled(hello(), true)) << "Hello twice";
  EXPECT_TRUE(isExpelled(msg::Welcome{}, true)) << "a master's message";
}

TEST_F(ClientSessionTest, PingsEverySecondAndMeasuresTheRoundTrip) {
  ClientSession s = ready();
  int pings = 0;
  for (int i = 0; i < 50; ++i) {
    s.tick(now += milliseconds(100));
    auto actions = s.takeActions();
    for (const msg::Ping& ping : sent<msg::Ping>(actions)) {
      ++pings;
      s.received(msg::Pong{ping.clockNs, 0}, now + milliseconds(30));
      auto answers = s.takeActions();
      const auto trips = take<todo::RoundTrip>(answers);
      ASSERT_EQ(trips.size(), 1u);
      EXPECT_EQ(trips[0].time, milliseconds(30));
    }
  }
  EXPECT_GE(pings, 4);
  EXPECT_LE(pings, 6);
  EXPECT_FALSE(s.over());
}

TEST_F(ClientSessionTest, ASilentClientIsLostWithinItsDeadline) {
  ClientSession s = ready();
  const Time begin = now;
  while (!s.over() && now - begin < seconds(60)) s.tick(now += milliseconds(100));
  EXPECT_GE(now - begin, ClientSession::kDeadAfter);
  EXPECT_LE(now - begin, ClientSession::kDeadAfter + milliseconds(300));

  ClientSession mute = session();
  for (int i = 0; i < 60; ++i) mute.tick(now += milliseconds(100));
  EXPECT_TRUE(mute.over()) << "it never said Hello";
}

TEST_F(ClientSessionTest, APauseOfTheMasterIsNoSilenceOfTheClient) {
  ClientSession s = ready();
  s.tick(now += milliseconds(100));
  s.tick(now += std::chrono::minutes(5));
  EXPECT_FALSE(s.over());
}

TEST_F(ClientSessionTest, KnowsHowFarTheTransferIs) {
  ClientSession s = session();
  EXPECT_EQ(s.status().state, ClientState::connecting);
  s.received(hello(), now);
  s.received(msg::Progress{Phase::fetching, 63, 100}, now);
  EXPECT_EQ(s.status().state, ClientState::syncing);
  EXPECT_DOUBLE_EQ(s.status().synced, 0.63);
  s.received(msg::Progress{Phase::building, 0, 1}, now);
  EXPECT_EQ(s.status().state, ClientState::building);
  s.received(msg::Ready{JobOffer::kScene, kJob}, now);
  s.received(msg::Progress{Phase::fetching, 0, 0}, now);
  EXPECT_EQ(s.status().state, ClientState::ready);
}

TEST_F(ClientSessionTest, TellsHowLongTheSceneTookToBuild) {
  ClientSession s = session();
  s.received(hello(), now);
  s.received(msg::Progress{Phase::building, 0, 1}, now);
  for (int i = 0; i < 40; ++i) s.received(msg::Progress{Phase::building, 0, 1}, now += seconds(1));
  s.received(msg::Ready{JobOffer::kScene, kJob}, now += seconds(2));
  auto actions = s.takeActions();
  const auto joins = take<todo::Join>(actions);
  ASSERT_EQ(joins.size(), 1u);
  EXPECT_EQ(joins[0].sceneTime, seconds(42));
}

TEST_F(ClientSessionTest, NothingFollowsTheEnd) {
  ClientSession s = ready();
  s.expel("tile 3 cannot be decoded");
  s.takeActions();
  s.received(msg::Ping{}, now);
  s.tick(now + seconds(100));
  s.expel("again");
  EXPECT_TRUE(s.takeActions().empty());
}

}  // namespace
}  // namespace ninefold
