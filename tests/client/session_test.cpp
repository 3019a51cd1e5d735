#include "client/session.h"

#include "tests/client/session_harness.h"

namespace ninefold {
namespace {

using std::chrono::minutes;
using std::chrono::seconds;

TEST(Session, IntroducesItselfFirst) {
  SessionHarness h;
  h.connect();
  const auto hello = h.sent<msg::Hello>();
  ASSERT_EQ(hello.size(), 1u);
  EXPECT_EQ(hello[0].name, "pc2");
}

TEST(Session, FetchesOnlyWhatTheCacheLacksAndThenBuildsAndIsReady) {
  SessionHarness h;
  h.welcome();
  const BlobInfo cached = SessionHarness::blob(1, 1000, BlobKind::image);
  const BlobInfo missing = SessionHarness::blob(2);
  h.session.received(msg::SceneOffer{1, {cached, missing}}, h.now);
  h.session.received(SessionHarness::settings(), h.now);
  const auto find = h.take<act::FindBlobs>();
  ASSERT_EQ(find.size(), 1u);
  EXPECT_EQ(find[0].manifest.size(), 2u);

  h.session.blobsFound(find[0].load, {missing}, h.now);
  const auto requests = h.sent<msg::BlobRequest>();
  ASSERT_EQ(requests.size(), 1u);
  EXPECT_EQ(requests[0].hash, missing.hash);
  h.session.received(msg::BlobChunk{missing.hash, 0, 5, Bytes(5)}, h.now);
  const auto keep = h.take<act::KeepBlob>();
  ASSERT_EQ(keep.size(), 1u);
  EXPECT_EQ(keep[0].compressed.size(), 5u);

  const auto build = h.take<act::BuildScene>();
  ASSERT_EQ(build.size(), 1u);
  EXPECT_TRUE(h.take<act::PrepareJob>().empty());
  h.session.sceneBuilt(build[0].load, h.now);
  const auto job = h.take<act::PrepareJob>();
  ASSERT_EQ(job.size(), 1u);
  EXPECT_TRUE(h.sent<msg::Ready>().empty());
  h.session.jobPrepared(job[0].load, job[0].line, job[0].jobVersion, h.now);
  EXPECT_EQ(h.sent<msg::Ready>().size(), 1u);
}

TEST(Session, TellsHowFarTheTransferIs) {
  SessionHarness h;
  h.welcome();
  const BlobInfo big = SessionHarness::blob(1, 1000);
  h.session.received(msg::SceneOffer{1, {big}}, h.now);
  h.session.blobsFound(h.take<act::FindBlobs>().at(0).load, {big}, h.now);
  h.session.received(msg::BlobChunk{big.hash, 0, 100, Bytes(25)}, h.now);
  h.forget();
  h.pass(seconds(1));
  const auto progress = h.sent<msg::Progress>();
  ASSERT_EQ(progress.size(), 1u);
  EXPECT_EQ(progress[0].done, 250u);
  EXPECT_EQ(progress[0].total, 1000u);
}

TEST(Session, RunsTasksAndSendsTheirResults) {
  SessionHarness h;
  h.becomeReady();
  msg::Tasks tasks{1, {}, {{0, 3, 0}, {0, 4, 0}}};
  h.session.received(Message(tasks), h.now);
  const auto start = h.take<act::StartTasks>();
  ASSERT_EQ(start.size(), 1u);
  EXPECT_EQ(start[0].tasks.items.size(), 2u);
  msg::Result result;
  result.jobVersion = 1, result.phase = 3;
  h.session.taskFinished(start[0].line, std::move(result), h.now);
  const auto sent = h.sent<msg::Result>();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].phase, 3u);
}

TEST(Session, StaysReadyWhileTheCameraMovesAndFinishesOlderJobs) {
  SessionHarness h;
  h.becomeReady();
  h.forget();
  for (uint32_t job = 2; job <= 4; ++job) h.session.received(SessionHarness::settings(job), h.now);
  EXPECT_EQ(h.take<act::PrepareJob>().size(), 3u);
  for (uint32_t job = 1; job <= 4; ++job)
    h.session.received(Message(msg::Tasks{job, {}, {{0, 0, 0}}}), h.now);
  EXPECT_EQ(h.take<act::StartTasks>().size(), 4u) << "before any of them was prepared";
  EXPECT_TRUE(h.session.jobPrepared(1, 1, 3, h.now));
  EXPECT_TRUE(h.sent<msg::Ready>().empty()) << "Ready is said once";
  for (uint32_t job = 5; job <= 1 + kJobsKept; ++job)
    h.session.received(SessionHarness::settings(job), h.now);
  EXPECT_FALSE(h.session.jobPrepared(1, 1, 1, h.now)) << "only the latest are kept";
  h.session.received(Message(msg::Tasks{1, {}, {{0, 0, 0}}}), h.now);
  EXPECT_EQ(h.take<act::Disconnect>().size(), 1u);
}

TEST(Session, AJobOfAnEarlierConnectionIsNotTakenForOneOfThis) {
  SessionHarness h;
  h.becomeReady();
  h.session.received(SessionHarness::settings(2), h.now);
  const act::PrepareJob old = h.take<act::PrepareJob>().at(0);
  h.session.disconnected("connection reset", h.now);
  h.pass(seconds(1));
  h.session.connected(h.now);
  h.session.received(msg::Welcome{1}, h.now);
  h.session.received(msg::SceneOffer{1, {SessionHarness::blob(1)}}, h.now);
  h.session.received(SessionHarness::settings(2), h.now);
  EXPECT_FALSE(h.session.jobPrepared(old.load, old.line, 2, h.now));
  const act::PrepareJob fresh = h.take<act::PrepareJob>().at(0);
  EXPECT_TRUE(h.session.jobPrepared(fresh.load, fresh.line, 2, h.now));
}

SceneEdit emptyRoom(uint32_t material) {
  SceneEdit edit;
  edit.materials.push_back({material, Vec3(0.5f), 0, 1, 0, 1.5f, Vec3(0)});
  return edit;
}

TEST(Session, EditsReachTheSceneInTheirOrderBeforeTheJobsThatSeeThem) {
  SessionHarness h;
  h.becomeReady();
  h.forget();
  h.session.received(msg::Edit{1, emptyRoom(0)}, h.now);
  h.session.received(SessionHarness::settings(2), h.now);
  const auto actions = h.session.takeActions();
  ASSERT_EQ(actions.size(), 2u);
  EXPECT_TRUE(std::holds_alternative<act::EditScene>(actions[0]));
  EXPECT_TRUE(std::holds_alternative<act::PrepareJob>(actions[1]));
}

TEST(Session, EditsWaitAsOneForASceneThatIsNotThereYet) {
  SessionHarness h;
  h.welcome();
  h.session.received(msg::SceneOffer{1, {SessionHarness::blob(1)}}, h.now);
  h.session.received(msg::Edit{5, emptyRoom(0)}, h.now);
  h.session.received(SessionHarness::settings(), h.now);
  for (uint32_t i = 1; i <= 3; ++i) h.session.received(msg::Edit{5 + i, emptyRoom(i % 2)}, h.now);
  EXPECT_TRUE(h.take<act::EditScene>().empty());
  h.session.blobsFound(h.take<act::FindBlobs>().at(0).load, {}, h.now);
  h.session.sceneBuilt(h.take<act::BuildScene>().at(0).load, h.now);
  const auto edits = h.take<act::EditScene>();
  ASSERT_EQ(edits.size(), 1u);
  EXPECT_EQ(edits[0].edit.materials.size(), 2u);
  EXPECT_EQ(h.take<act::PrepareJob>().size(), 1u);
}

TEST(Session, InAGestureTheyWaitAsTwo) {
  SessionHarness h;
  h.welcome();
  h.session.received(msg::SceneOffer{1, {SessionHarness::blob(1)}}, h.now);
  h.session.received(msg::Edit{1, emptyRoom(0), false}, h.now);
  h.session.received(msg::Edit{2, emptyRoom(1), true}, h.now);
  h.session.received(msg::Edit{3, {}, false},
                     h.now);  // the end of one: it belongs to what was before
  for (const uint32_t i : {2u, 3u}) h.session.received(msg::Edit{2 + i, emptyRoom(i), true}, h.now);
  h.session.received(SessionHarness::settings(), h.now);
  h.session.blobsFound(h.take<act::FindBlobs>().at(0).load, {}, h.now);
  h.session.sceneBuilt(h.take<act::BuildScene>().at(0).load, h.now);
  const auto edits = h.take<act::EditScene>();
  ASSERT_EQ(edits.size(), 2u);
  EXPECT_FALSE(edits[0].moving);
  EXPECT_EQ(edits[0].edit.materials.size(), 2u);
  EXPECT_TRUE(edits[1].moving);
  EXPECT_EQ(edits[1].edit.materials.size(), 2u);
}

TEST(Session, ARestartedMasterGetsTheSceneAsItWasFetched) {
  SessionHarness h;
  h.becomeReady();
  h.session.received(msg::Edit{1, emptyRoom(0)}, h.now);
  for (int restart = 0; restart < 2; ++restart) {
    h.session.disconnected("connection reset", h.now);
    h.pass(seconds(1));
    h.forget();
    h.session.connected(h.now);
    h.session.received(msg::Welcome{1}, h.now);
    h.session.received(msg::SceneOffer{1, {SessionHarness::blob(1)}}, h.now);
    EXPECT_EQ(h.take<act::RestoreScene>().size(), restart == 0 ? 1u : 0u);
  }
}

TEST(Session, LeavesAMasterWhoseJobsRunBackwards) {
  SessionHarness h;
  h.becomeReady();
  h.session.received(SessionHarness::settings(1), h.now);
  EXPECT_EQ(h.take<act::Disconnect>().size(), 1u);
}

TEST(Session, LeavesAMasterThatAsksForPixelsOutsideThePicture) {
  for (const msg::TaskItem outside : {msg::TaskItem{1, 0, 0}, msg::TaskItem{0, 9, 0}}) {
    SessionHarness h;
    h.becomeReady();
    h.session.received(Message(msg::Tasks{1, {}, {outside}}), h.now);
    EXPECT_TRUE(h.take<act::StartTasks>().empty());
    EXPECT_EQ(h.take<act::Disconnect>().size(), 1u);
  }
}

TEST(Session, PassesCancellationsOnWhileReady) {
  SessionHarness h;
  h.becomeReady();
  h.session.received(msg::Cancel{1, 5}, h.now);
  const auto cancel = h.take<act::CancelTasks>();
  ASSERT_EQ(cancel.size(), 1u);
  EXPECT_EQ(cancel[0].frame, 5u);
  EXPECT_FALSE(cancel[0].everything);
}

TEST(Session, AnswersPings) {
  SessionHarness h;
  h.welcome();
  h.session.received(msg::Ping{42}, h.now);
  const auto pong = h.sent<msg::Pong>();
  ASSERT_EQ(pong.size(), 1u);
  EXPECT_EQ(pong[0].echoNs, 42u);
}

TEST(Session, DialsAgainEverMoreRarelyAndGivesUpInTheEnd) {
  SessionHarness h;
  h.session.tick(h.now);
  const Time start = h.now;
  int attempts = 0;
  std::vector<act::Exit> exits;
  while (exits.empty() && h.now - start < minutes(60)) {
    if (!h.take<act::Connect>().empty()) {
      ++attempts;
      h.session.connectFailed("nobody listens at 10.0.0.1:4700", false, h.now);
    }
    h.pass(milliseconds(100));
    exits = h.take<act::Exit>();
  }
  ASSERT_EQ(exits.size(), 1u);
  EXPECT_EQ(exits[0].status, 1);
  EXPECT_GE(h.now - start, Session::kPatience);
  // Pauses grow to between half of kLongest and all of it.
  EXPECT_GE(attempts, Session::kPatience / Backoff::kLongest);
  EXPECT_LE(attempts, 2 * (Session::kPatience / Backoff::kLongest) + 10);
  EXPECT_EQ(h.take<act::Tell>().size(), 1u) << "the same trouble is told once";
}

TEST(Session, ALocalClientEndsWithItsConnection) {
  SessionHarness h(false);
  h.becomeReady();
  h.session.disconnected("end of stream", h.now);
  const auto exits = h.take<act::Exit>();
  ASSERT_EQ(exits.size(), 1u);
  EXPECT_EQ(exits[0].status, 1);
}

TEST(Session, KeepsItsSceneForARestartedMaster) {
  SessionHarness h;
  h.becomeReady();
  h.session.disconnected("connection reset", h.now);
  h.forget();
  h.pass(seconds(1));
  ASSERT_EQ(h.take<act::Connect>().size(), 1u);
  h.session.connected(h.now);
  h.session.received(msg::Welcome{1}, h.now);
  h.session.received(msg::SceneOffer{1, {SessionHarness::blob(1)}}, h.now);
  h.session.received(SessionHarness::settings(), h.now);
  EXPECT_TRUE(h.take<act::FindBlobs>().empty());
  EXPECT_EQ(h.take<act::PrepareJob>().size(), 1u);
}

TEST(Session, FetchesTheSceneOfAMasterThatComesBackWithAnotherOne) {
  SessionHarness h;
  h.becomeReady();
  h.session.disconnected("connection reset", h.now);
  h.pass(seconds(1));
  h.session.connected(h.now);
  h.session.received(msg::Welcome{1}, h.now);
  h.session.received(msg::SceneOffer{1, {SessionHarness::blob(9)}}, h.now);
  EXPECT_EQ(h.take<act::FindBlobs>().size(), 1u);
}

TEST(Session, ResultsOfAnOldConnectionDoNotReachTheNewOne) {
  SessionHarness h;
  h.becomeReady();
  h.session.received(Message(msg::Tasks{1, {}, {{0, 0, 0}}}), h.now);
  const uint32_t oldLine = h.take<act::StartTasks>().at(0).line;
  h.session.disconnected("connection reset", h.now);
  const auto cancel = h.take<act::CancelTasks>();
  ASSERT_EQ(cancel.size(), 1u);
  EXPECT_TRUE(cancel[0].everything);
  h.pass(seconds(1));
  h.forget();
  h.session.connected(h.now);
  h.session.received(msg::Welcome{1}, h.now);
  h.session.received(msg::SceneOffer{1, {SessionHarness::blob(1)}}, h.now);
  h.session.received(SessionHarness::settings(), h.now);
  for (const auto& job : h.take<act::PrepareJob>())
    h.session.jobPrepared(job.load, job.line, job.jobVersion, h.now);
  msg::Result result;
  result.jobVersion = 1;
  h.session.taskFinished(oldLine, std::move(result), h.now);
  EXPECT_TRUE(h.sent<msg::Result>().empty());
}

TEST(Session, EveryWaitEnds) {
  {
    SessionHarness h;  // no Welcome
    h.connect();
    for (int i = 0; i < 70; ++i) h.pass(milliseconds(100));
    EXPECT_EQ(h.take<act::Disconnect>().size(), 1u);
  }
  {
    SessionHarness h;  // a master that pings but sends no piece
    h.welcome();
    const BlobInfo blob = SessionHarness::blob(1);
    h.session.received(msg::SceneOffer{1, {blob}}, h.now);
    h.session.blobsFound(h.take<act::FindBlobs>().at(0).load, {blob}, h.now);
    for (int i = 0; i < 250; ++i) {
      h.pass(milliseconds(100));
      h.session.received(msg::Ping{}, h.now);
    }
    EXPECT_EQ(h.take<act::Disconnect>().size(), 1u);
  }
  {
    SessionHarness h;  // silence
    h.becomeReady();
    for (int i = 0; i < 110; ++i) h.pass(milliseconds(100));
    EXPECT_EQ(h.take<act::Disconnect>().size(), 1u);
  }
}

TEST(Session, APauseOfItsOwnIsNoSilenceOfTheMaster) {
  SessionHarness h;
  h.becomeReady();
  h.pass(minutes(5));  // the process was stopped
  EXPECT_TRUE(h.take<act::Disconnect>().empty());
}

TEST(Session, EndsWellWhenTheMasterIsDoneAndBadlyWhenItRefuses) {
  SessionHarness done;
  done.becomeReady();
  done.session.received(msg::Goodbye{"picture finished"}, done.now);
  EXPECT_EQ(done.take<act::Exit>().at(0).status, 0);

  SessionHarness refused;
  refused.connect();
  refused.session.received(msg::Refuse{"use one release"}, refused.now);
  const act::Exit exit = refused.take<act::Exit>().at(0);
  EXPECT_EQ(exit.status, 1);
  EXPECT_NE(exit.line.find("use one release"), std::string::npos);
}

TEST(Session, RefusesAMasterOfAnotherReleaseNamingBoth) {
  SessionHarness h;
  h.connect();
  h.session.received(msg::Welcome{1, "99.9.9"}, h.now);
  const act::Exit exit = h.take<act::Exit>().at(0);
  EXPECT_EQ(exit.status, 1);
  EXPECT_NE(exit.line.find("99.9.9"), std::string::npos);
  EXPECT_NE(exit.line.find(releaseName()), std::string::npos);
}

TEST(Session, SaysGoodbyeWhenTheUserStopsIt) {
  SessionHarness h;
  h.becomeReady();
  h.session.stop("stopped by a signal");
  EXPECT_EQ(h.sent<msg::Goodbye>().size(), 1u);
  EXPECT_EQ(h.take<act::Exit>().at(0).status, 0);
}

TEST(Session, AWrongKeyIsFinal) {
  SessionHarness h;
  h.session.tick(h.now);
  h.session.connectFailed("the master does not know this key", true, h.now);
  EXPECT_EQ(h.take<act::Exit>().at(0).status, 1);
}

}  // namespace
}  // namespace ninefold
