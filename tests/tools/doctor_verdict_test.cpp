// What ninefold-doctor makes of facts. Against real masters: tests/cluster/doctor_test.py.
#include "tools/doctor_verdict.h"

#include <gtest/gtest.h>

#include <map>

#include "tools/doctor_machine.h"

namespace ninefold {
namespace {

using std::chrono::microseconds;

VisitFacts welcomed(const std::string& probeClass = "aaaa") {
  VisitFacts v;
  v.peer = "10.0.0.1:4700";
  v.welcome = msg::Welcome{1, releaseName(), probeClass, 1'000'000};
  v.ourClockMs = 1'000'000;
  v.roundTrip = microseconds(200);
  v.loadBytes = 100'000'000, v.loadTime = std::chrono::seconds(1);
  return v;
}

msg::Hello ours() {
  msg::Hello hello;
  hello.probeClass = "aaaa";
  return hello;
}

std::map<std::string, Finding> byName(const Findings& all) {
  std::map<std::string, Finding> named;
  for (const Finding& f : all) named[f.what] = f;
  return named;
}

TEST(DoctorVerdict, AllIsWell) {
  for (const Finding& f : judgeVisit(welcomed(), ours()))
    EXPECT_EQ(f.grade, Grade::good) << lineOf(f);
  EXPECT_EQ(judgeReach(welcomed(), {"pc1", 4700}, {}).size(), 3u);
}

TEST(DoctorVerdict, ClocksMayDifferBySeconds) {
  VisitFacts v = welcomed();
  const auto clock = [&](uint64_t theirs) {
    v.welcome->wallClockMs = theirs;
    return byName(judgeVisit(v, ours()))["clock"];
  };
  EXPECT_EQ(clock(1'004'000).grade, Grade::good);
  EXPECT_NE(clock(1'004'000).found.find("+4.000 s"), std::string::npos) << clock(1'004'000).found;
  EXPECT_EQ(clock(1'006'000).grade, Grade::note);
  EXPECT_EQ(clock(994'000).grade, Grade::note);
  EXPECT_NE(clock(994'000).found.find("-6.000 s"), std::string::npos);
  EXPECT_NE(clock(0).todo, "");
  // The master looked at its clock half a round trip before its answer came.
  v.roundTrip = std::chrono::seconds(2);
  EXPECT_NE(clock(999'000).found.find("+0.000 s"), std::string::npos) << clock(999'000).found;
}

TEST(DoctorVerdict, ASlowLineAndALateAnswerAreNotes) {
  EXPECT_EQ(judgeRoundTrip(milliseconds(50)).grade, Grade::good);
  EXPECT_EQ(judgeRoundTrip(milliseconds(51)).grade, Grade::note);
  EXPECT_EQ(judgeLine(2'000'000, std::chrono::seconds(1)).grade, Grade::good);
  EXPECT_EQ(judgeLine(2'000'000, std::chrono::seconds(2)).grade, Grade::note);
  EXPECT_NE(judgeLine(2'000'000, std::chrono::seconds(2)).found.find("1.0 MB/s"),
            std::string::npos);
  EXPECT_EQ(judgeLine(0, Duration{0}).grade, Grade::skipped);
}

TEST(DoctorVerdict, AnotherPixelClassIsANote) {
  EXPECT_EQ(judgeClass(*welcomed("bbbb").welcome, ours()).grade, Grade::note);
  EXPECT_EQ(judgeClass(*welcomed("").welcome, ours()).grade, Grade::good);
}

TEST(DoctorVerdict, WhatCannotBeLookedAtIsSaidToBeSkipped) {
  VisitFacts v;
  v.failure = ConnectFailure{ConnectProblem::refused, "nobody listens there"};
  auto reach = byName(judgeReach(v, {"pc1", 4700}, {}));
  EXPECT_EQ(reach["port"].grade, Grade::bad);
  EXPECT_EQ(reach["key"].grade, Grade::skipped);
  for (const Finding& f : judgeVisit(v, ours())) EXPECT_EQ(f.grade, Grade::skipped) << lineOf(f);
  VisitFacts mute;
  mute.peer = "10.0.0.1:4700", mute.lost = "it is silent";
  EXPECT_EQ(judgeVisit(mute, ours())[0].grade, Grade::bad);
  VisitFacts refused;
  refused.peer = "10.0.0.1:4700", refused.refusal = "another release";
  EXPECT_EQ(judgeVisit(refused, ours())[0].found, "another release");
}

TEST(DoctorVerdict, SpaceAndDescriptorsHaveLimits) {
  EXPECT_EQ(judgeSpace("c", BlobCache::kDefaultMaxBytes).grade, Grade::good);
  EXPECT_EQ(judgeSpace("c", BlobCache::kDefaultMaxBytes - 1).grade, Grade::note);
  EXPECT_EQ(judgeDescriptors(63).grade, Grade::note);
  EXPECT_NE(judgeDescriptors(63).todo, judgeDescriptors(64).todo);
  EXPECT_EQ(judgeDescriptors(64).grade, Grade::note);
  EXPECT_EQ(judgeDescriptors(1024).grade, Grade::good);
}

TEST(DoctorVerdict, ALineTellsWhatItFoundAndWhatToDo) {
  EXPECT_EQ(lineOf({Grade::bad, "key", "none is given", "give it"}),
            "BAD   key              none is given; give it\n");
  EXPECT_EQ(lineOf({Grade::good, "line", "9 MB/s"}), "ok    line             9 MB/s\n");
}

}  // namespace
}  // namespace ninefold
