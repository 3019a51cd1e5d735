// A state on its way: units of steps come to the master in any order, and clients get what makes
// their copies the same, over the bytes of the wire. A client that joins late has the same pages as
// one from the start, bit for bit.
#include <gtest/gtest.h>

#include <random>

#include "client/state_store.h"
#include "master/serving/job_offer.h"
#include "master/serving/state_keeper.h"
#include "proto/state_wire.h"

namespace ninefold {
namespace {

template <typename M>
M overTheWire(const M& message, Peer sender) {
  return std::get<M>(decodeMessage(encodeMessage(Message(message)), sender));
}

// Units write records of their own, and add to sums that they share.
PageDeltas deltasOf(uint32_t version, uint32_t unit, std::mt19937& random) {
  Records records(100 + random() % 1000);
  for (std::byte& byte : records) byte = static_cast<std::byte>(random());
  std::vector<SumChange> changes;
  for (uint16_t i = 0; i < 50; ++i)
    changes.push_back({static_cast<uint16_t>(random() % kPageSums),
                       static_cast<int64_t>(random()) - static_cast<int64_t>(random())});
  return {{{0, unit}, records}, {{1, (unit + version) % 3}, changes}};
}

class StateTravel : public testing::Test {
 protected:
  static constexpr uint32_t kUnits = 7;

  void begin(uint32_t from, uint32_t to) {
    step = {.number = to, .from = from, .to = to, .firstUnit = 100 * to, .units = kUnits};
    keeper.open(step);
    results.clear();
    for (uint32_t unit = 0; unit < kUnits; ++unit) {
      msg::Stepped result;
      result.number = step.number, result.unit = step.firstUnit + unit;
      result.stateHash = hashes[from];
      result.deltas = encodeDeltas(deltasOf(to, unit, random));
      results.push_back(result);
    }
  }
  void end() {
    std::ranges::shuffle(results, random);
    for (msg::Stepped& result : results) keeper.take(overTheWire(result, Peer::client));
    const auto messages = keeper.complete(step.number);
    hashes[step.to] = messages.front().hash;
    for (StateStore* store : stores)
      for (const msg::StateDelta& m : messages) store->add(overTheWire(m, Peer::master));
  }
  // As ClientSession and Session do it.
  void join(StateStore& store) {
    snapshot = keeper.snapshot();
    if (snapshot) store.offer(overTheWire(snapshot->offer, Peer::master));
    for (const msg::StateDelta& m : keeper.since()) store.add(overTheWire(m, Peer::master));
    stores.push_back(&store);
  }
  void fetch(StateStore& store) {
    for (auto asked = store.requests(); !asked.empty(); asked = store.requests())
      for (const msg::BlobRequest& request : asked)
        store.chunk(pieceOf(snapshot->blobs.at(request.hash), request));
  }
  uint64_t hashAt(const StateStore& store, uint32_t version) const {
    const auto pages = store.find(version);
    return pages ? pages->hash() : 0;
  }

  std::mt19937 random{7};
  StateKeeper keeper;
  StepKey step;
  std::vector<msg::Stepped> results;
  std::map<uint32_t, uint64_t> hashes{{0, 0}};
  std::vector<StateStore*> stores;
  std::shared_ptr<const StateKeeper::Snapshot> snapshot;
};

TEST_F(StateTravel, ClientsHaveWhatTheMasterHas) {
  StateStore store;
  join(store);
  for (uint32_t version = 1; version <= 5; ++version) {
    begin(version - 1, version), end();
    EXPECT_EQ(hashAt(store, version), hashes[version]);
  }
  EXPECT_NE(hashes[4], hashes[5]);
}

TEST_F(StateTravel, WhoComesLateHasTheSamePagesWhileStepsGoOn) {
  StateStore early, late;
  join(early);
  for (uint32_t version = 1; version <= 4; ++version) begin(version - 1, version), end();
  keeper.forget(3);  // frames name it
  begin(4, 5);
  join(late);
  end();  // while the late one fetches
  EXPECT_FALSE(late.isWhole());
  EXPECT_FALSE(late.find(5));
  fetch(late);
  EXPECT_TRUE(late.isWhole());
  for (const uint32_t version : {3u, 4u, 5u}) EXPECT_EQ(hashAt(late, version), hashes[version]);
  EXPECT_FALSE(late.find(2)) << "nothing names it any more";
  begin(5, 6), end();
  EXPECT_EQ(hashAt(late, 6), hashAt(early, 6));
}

TEST_F(StateTravel, AStateThatBeginsAnewNeedsNoOlderOne) {
  StateStore store;
  join(store);
  begin(0, 1), end();
  begin(0, 2), end();
  EXPECT_EQ(hashAt(store, 2), hashes[2]);
  EXPECT_NE(hashes[1], hashes[2]);
}

TEST_F(StateTravel, VersionsThatNobodyNamesAreDropped) {
  StateStore store;
  join(store);
  for (uint32_t version = 1; version <= 4; ++version) {
    begin(version - 1, version), end();
    keeper.forget(version);
  }
  EXPECT_TRUE(store.find(4));
  EXPECT_FALSE(store.find(2));
}

TEST_F(StateTravel, UnitsOfAnotherStateAreRefused) {
  begin(0, 1), end();
  begin(1, 2);
  results[3].stateHash += 1;
  EXPECT_THROW(keeper.take(std::move(results[3])), Error);
}

TEST_F(StateTravel, MalformedDeltasAreRefusedAndTheUnitCanBeMadeAgain) {
  StateStore store;
  join(store);
  begin(0, 1);
  msg::Stepped broken = results[2];
  broken.deltas.resize(broken.deltas.size() / 2);
  EXPECT_THROW(keeper.take(std::move(broken)), Error);
  end();
  EXPECT_EQ(hashAt(store, 1), hashes[1]);
}

TEST_F(StateTravel, AWrongVersionIsNoticedByItsHash) {
  begin(0, 1);
  for (msg::Stepped& result : results) keeper.take(std::move(result));
  auto messages = keeper.complete(1);
  StateStore store;
  messages.back().deltas = encodeDeltas({});
  for (size_t i = 0; i + 1 < messages.size(); ++i) store.add(std::move(messages[i]));
  EXPECT_THROW(store.add(std::move(messages.back())), Error);
}

TEST_F(StateTravel, PartsMustFollowEachOther) {
  begin(0, 1);
  for (msg::Stepped& result : results) keeper.take(std::move(result));
  auto messages = keeper.complete(1);
  StateStore store;
  store.add(std::move(messages[0]));
  EXPECT_THROW(store.add(std::move(messages[2])), Error);
}

TEST_F(StateTravel, ASumThatOverflowsIsAnError) {
  step = {.number = 1, .from = 0, .to = 1, .units = 3};
  keeper.open(step);
  const auto add = [&](uint32_t unit, int64_t amount) {
    msg::Stepped result;
    result.number = 1, result.unit = unit;
    result.deltas = encodeDeltas({{{1, 0}, std::vector<SumChange>{{5, amount}}}});
    keeper.take(std::move(result));
  };
  constexpr int64_t kMost = std::numeric_limits<int64_t>::max();
  add(0, kMost / 2), add(1, kMost / 2), add(2, 2);
  EXPECT_THROW(keeper.complete(1), Error);
}

TEST_F(StateTravel, AUnitThatTheStateCannotTakeIsItsClientsFault) {
  begin(0, 1), end();
  begin(1, 2);
  msg::Stepped wrong = results[0];  // sums where there are records
  wrong.deltas = encodeDeltas({{{0, 0}, std::vector<SumChange>{{5, 1}}}});
  EXPECT_THROW(keeper.take(std::move(wrong)), Error);
  end();
  EXPECT_NE(hashes[2], hashes[1]);
}

TEST_F(StateTravel, StepsThatAreVoidLeaveNoTrace) {
  StateStore store;
  join(store);
  begin(0, 1), end();
  begin(1, 2);
  keeper.take(std::move(results[0]));
  keeper.drop(3);
  begin(1, 4), end();
  EXPECT_EQ(hashAt(store, 4), hashes[4]);
}

}  // namespace
}  // namespace ninefold
