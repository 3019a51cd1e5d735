// A client's session with a method's state: it is ready when its pages are there, and does no work
// on a version that is not.
#include "proto/state_wire.h"
#include "tests/client/session_harness.h"

namespace ninefold {
namespace {

const PageDeltas kFirst{{{0, 3}, Records(100, std::byte{7})}};
const PageDeltas kSecond{{{0, 4}, Records(50, std::byte{9})}};

StatePages pagesOf(const std::vector<PageDeltas>& all) {
  StatePages pages;
  for (const PageDeltas& deltas : all) pages.apply(deltas);
  return pages;
}

class SessionState : public testing::Test {
 protected:
  // Offered at version 5, with a delta to version 6, before the settings.
  void join() {
    h.welcome();
    h.session.received(msg::SceneOffer{1, {SessionHarness::blob(1)}}, h.now);
    msg::StateOffer offer{5, pagesOf({kFirst}).hash(), {{kFirst[0].page, page.info}}};
    h.session.received(std::move(offer), h.now);
    h.session.received(delta(5, 6), h.now);
    h.session.received(SessionHarness::settings(), h.now);
    for (const auto& find : h.take<act::FindBlobs>()) h.session.blobsFound(find.load, {}, h.now);
    for (const auto& build : h.take<act::BuildScene>()) h.session.sceneBuilt(build.load, h.now);
  }
  void fetch() {
    for (const auto& request : h.sent<msg::BlobRequest>())
      h.session.received(msg::BlobChunk{request.hash, 0, page.compressed.size(), page.compressed},
                         h.now);
    for (const auto& job : h.take<act::PrepareJob>())
      h.session.jobPrepared(job.load, job.line, job.jobVersion, h.now);
  }
  static msg::StateDelta delta(uint32_t from, uint32_t to) {
    return {from, to, 0, 1, pagesOf({kFirst, kSecond}).hash(), from, encodeDeltas(kSecond)};
  }
  static msg::Tasks tasks(uint32_t state) {
    msg::Tasks m;
    m.jobVersion = 1, m.items = {{0, 0, 0}}, m.frame.state = state;
    return m;
  }

  SessionHarness h;
  Blob page = packPage(kFirst[0].page, std::get<Records>(kFirst[0].change));
};

TEST_F(SessionState, IsReadyOnceItsPagesAreThere) {
  join();
  EXPECT_TRUE(h.take<act::PrepareJob>().empty());
  fetch();
  EXPECT_EQ(h.sent<msg::Ready>().size(), 1u);
  for (const uint32_t version : {5u, 6u}) {
    h.session.received(tasks(version), h.now);
    const auto started = h.take<act::StartTasks>();
    ASSERT_EQ(started.size(), 1u);
    EXPECT_EQ(started[0].state->hash(),
              version == 5 ? pagesOf({kFirst}).hash() : pagesOf({kFirst, kSecond}).hash());
  }
}

TEST_F(SessionState, UnitsGetThePagesThatTheirStepBeginsFrom) {
  join(), fetch();
  msg::Steps steps;
  steps.jobVersion = 1, steps.units = {40, 41};
  steps.step = {.number = 9, .from = 6, .to = 7, .firstUnit = 40};
  h.session.received(std::move(steps), h.now);
  const auto started = h.take<act::StartSteps>();
  ASSERT_EQ(started.size(), 1u);
  EXPECT_EQ(started[0].state->hash(), pagesOf({kFirst, kSecond}).hash());
  h.session.unitFinished(started[0].line, {});
  EXPECT_EQ(h.sent<msg::Stepped>().size(), 1u);
  h.session.received(msg::CancelSteps{10}, h.now);
  EXPECT_EQ(h.take<act::CancelUnits>().at(0).number, 10u);
}

TEST_F(SessionState, LeavesAMasterThatAsksForTasksOfAStateThatIsNotThere) {
  join(), fetch();
  h.session.received(tasks(8), h.now);
  EXPECT_TRUE(h.take<act::StartTasks>().empty());
  EXPECT_NE(h.take<act::Disconnect>().at(0).reason.find("version 8"), std::string::npos);
}

TEST_F(SessionState, LeavesAMasterThatAsksForUnitsOfAStateThatIsNotThere) {
  join(), fetch();
  msg::Steps steps;
  steps.jobVersion = 1, steps.units = {0}, steps.step = {.number = 9, .from = 8, .to = 9};
  h.session.received(std::move(steps), h.now);
  EXPECT_TRUE(h.take<act::StartSteps>().empty());
  EXPECT_NE(h.take<act::Disconnect>().at(0).reason.find("version 8"), std::string::npos);
}

TEST_F(SessionState, LeavesAMasterWhosePageIsAnotherThanItOffered) {
  page.info.hash[5] ^= 1;
  join(), fetch();
  EXPECT_TRUE(h.sent<msg::Ready>().empty());
  EXPECT_EQ(h.take<act::Disconnect>().size(), 1u);
}

TEST_F(SessionState, BeginsAnewWithAnotherConnection) {
  join(), fetch();
  h.session.disconnected("cut", h.now);
  h.forget();
  h.pass(std::chrono::minutes(2));
  join();  // the scene is kept, the pages are not
  EXPECT_TRUE(h.sent<msg::Ready>().empty());
  fetch();
  EXPECT_EQ(h.sent<msg::Ready>().size(), 1u);
}

}  // namespace
}  // namespace ninefold
