// What each viewer may say, and what it gets next.
#include "master/web/web_hub.h"

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "common/base/error.h"

namespace ninefold {
namespace {

using nlohmann::json;

constexpr Time kStart = Time{} + std::chrono::hours(1);

Time after(double s) { return kStart + fromSeconds(s); }

std::shared_ptr<WebPicture> picture(int64_t frames = 0, int side = 8) {
  DisplayImage codes;
  codes.reshape(side, side);
  std::fill(codes.rgb.begin(), codes.rgb.end(), uint8_t{100});
  return std::make_shared<WebPicture>(std::move(codes), frames);
}

WebOffer offerOf(std::shared_ptr<WebPicture> shown, const std::string& state = "{}") {
  return {std::move(shown), state, ""};
}

said::Event move(float x) {
  said::Event said;
  said.event.pointer = Vec2(x, 0);
  return said;
}

// A viewer that has shown what it got at first.
ViewerId joined(WebHub& hub, Time now = kStart) {
  const ViewerId id = hub.join(now);
  if (hub.next(id, now)) hub.hear(id, said::Shown{}, now);
  return id;
}

TEST(WebHub, OneUpdateIsUnderWayAtMost) {
  WebHub hub;
  hub.offer(offerOf(picture()));
  const ViewerId id = hub.join(kStart);
  EXPECT_TRUE(hub.next(id, kStart));
  hub.offer(offerOf(picture()));
  EXPECT_FALSE(hub.next(id, after(1)));
  hub.hear(id, said::Shown{}, after(1));
  EXPECT_TRUE(hub.next(id, after(1)));
}

TEST(WebHub, TheNewestPictureComesNext) {
  WebHub hub;
  hub.offer(offerOf(picture(0, 8)));
  const ViewerId id = hub.join(kStart);
  hub.next(id, kStart);
  for (const int side : {9, 10, 11}) hub.offer(offerOf(picture(0, side)));
  hub.hear(id, said::Shown{}, after(0.1));
  const auto newest = picture(0, 11);
  EXPECT_EQ(hub.next(id, after(0.1))->body->bytes, newest->as(2)->bytes);
}

// Whether the viewer gets a picture at that time, which it shows at once.
bool sees(WebHub& hub, ViewerId id, Time now) {
  const auto update = hub.next(id, now);
  if (!update) return false;
  hub.hear(id, said::Shown{}, now);
  return update->body != nullptr;
}

// A picture at rest that gets better with each frame.
TEST(WebHub, AtRestPicturesComeTwiceASecondAndAllViewersGetTheSame) {
  WebHub hub;
  std::array<ViewerId, 3> viewers{};
  for (ViewerId& id : viewers) id = hub.join(kStart);
  std::set<std::shared_ptr<const WebBody>> bodies;
  std::array<int, 3> seen{};
  for (int frame = 0; frame < 200; ++frame) {  // 10 ms each
    const Time now = after(0.01 * frame);
    hub.offer(offerOf(picture(PicturePace::kCalm + frame)));
    for (size_t v = 0; v < viewers.size(); ++v) {
      if (frame % 7 != static_cast<int>(v)) continue;  // they look at different times
      const auto update = hub.next(viewers[v], now);
      if (!update) continue;
      hub.hear(viewers[v], said::Shown{}, now);
      if (update->body != nullptr) bodies.insert(update->body), ++seen[v];
    }
  }
  EXPECT_EQ(seen, (std::array{4, 4, 4}));
  EXPECT_EQ(bodies.size(), 4u);
}

TEST(WebHub, AtRestAnotherFilmAndAnotherLookComeAtOnce) {
  WebHub hub;
  hub.offer(offerOf(picture(PicturePace::kCalm)));
  const ViewerId id = hub.join(kStart);
  EXPECT_TRUE(sees(hub, id, kStart));
  hub.offer(offerOf(picture(PicturePace::kCalm + 1)));
  EXPECT_FALSE(sees(hub, id, after(0.01)));
  hub.offer(offerOf(picture(PicturePace::kCalm)));
  EXPECT_TRUE(sees(hub, id, after(0.02))) << "another exposure";
  hub.offer(offerOf(picture(0)));
  EXPECT_TRUE(sees(hub, id, after(0.03))) << "it moves";
  hub.offer(offerOf(picture(1)));
  EXPECT_TRUE(sees(hub, id, after(0.04)));
  hub.offer(offerOf(picture(PicturePace::kCalm)));
  EXPECT_TRUE(sees(hub, id, after(0.05))) << "the first of the calm ones";
}

TEST(WebHub, NothingNewIsNotSaid) {
  WebHub hub;
  hub.offer(offerOf(picture()));
  const ViewerId id = joined(hub);
  EXPECT_FALSE(hub.next(id, after(100)));
  hub.offer(offerOf(hub.offered().picture, R"({"state":"2 ready"})"));
  const auto update = hub.next(id, after(101));
  ASSERT_TRUE(update);
  EXPECT_EQ(update->body, nullptr);
  EXPECT_EQ(json::parse(update->head)["state"], "2 ready");
}

TEST(WebHub, WhatIsToldWithoutAPictureComesFourTimesASecond) {
  WebHub hub;
  const ViewerId id = joined(hub);
  hub.offer(offerOf(nullptr, R"({"n":1})"));
  EXPECT_FALSE(hub.next(id, after(0.249)));
  EXPECT_TRUE(hub.next(id, after(0.25)));
}

TEST(WebHub, AHeadTellsWhoIsWho) {
  WebHub hub;
  const ViewerId first = joined(hub), second = hub.join(kStart);
  hub.hear(second, said::Ask{}, kStart);
  const json head = json::parse(hub.next(second, kStart)->head);
  EXPECT_EQ(head["you"], second);
  EXPECT_EQ(head["control"], first);
  EXPECT_EQ(head["asking"], json::array({second}));
  EXPECT_EQ(head["viewers"], 2);
}

TEST(WebHub, OnlyWhoIsInControlIsHeard) {
  WebHub hub;
  const ViewerId first = joined(hub), second = joined(hub);
  hub.takeHeard();
  hub.hear(second, move(5), kStart);
  hub.hear(second, said::View{PictureView::depth}, kStart);
  hub.hear(second, said::Lamp{0}, kStart);
  EXPECT_TRUE(hub.takeHeard().empty());
  hub.hear(first, move(5), after(2));
  const auto heard = hub.takeHeard();
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(std::get<said::Event>(heard[0].what).event.time, after(2));
}

TEST(WebHub, WhoTakesOverBeginsWithNothingHeld) {
  WebHub hub;
  const ViewerId first = joined(hub), second = joined(hub);
  hub.hear(second, said::Size{{640, 480}}, kStart);
  hub.hear(second, said::Ask{}, kStart);
  hub.takeHeard();
  hub.hear(first, said::Give{}, kStart);
  const auto heard = hub.takeHeard();
  ASSERT_EQ(heard.size(), 2u);
  EXPECT_TRUE(std::holds_alternative<NewHand>(heard[0].what));
  EXPECT_EQ(std::get<said::Size>(heard[1].what).size, Vec2(640, 480));
  EXPECT_EQ(heard[1].viewer, second);
}

TEST(WebHub, WhatIsHeldIsLetGoWhenNobodyIsLeft) {
  WebHub hub;
  const ViewerId id = joined(hub);
  hub.takeHeard();
  hub.leave(id);
  const auto heard = hub.takeHeard();
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<NewHand>(heard[0].what));
}

TEST(WebHub, AnybodyMayTakeAFileButOneAtATime) {
  WebHub hub;
  joined(hub);
  const ViewerId second = joined(hub);
  hub.takeHeard();
  const said::Download exr{said::Download::Kind::exr};
  hub.hear(second, exr, kStart);
  hub.hear(second, exr, kStart);
  EXPECT_EQ(hub.takeHeard().size(), 1u);
  hub.send(second, std::make_shared<const WebBody>(WebBody{"image/x-exr", "a.exr", {1, 2}}));
  const auto update = hub.next(second, kStart);
  ASSERT_TRUE(update && update->body);
  EXPECT_EQ(json::parse(update->head)["file"], "a.exr");
  EXPECT_EQ(update->body->bytes, (std::vector<uint8_t>{1, 2}));
  hub.hear(second, exr, kStart);
  EXPECT_EQ(hub.takeHeard().size(), 1u);
}

TEST(WebHub, AFileForWhoHasLeftIsNobodys) {
  WebHub hub;
  const ViewerId id = joined(hub);
  hub.leave(id);
  hub.send(id, std::make_shared<const WebBody>());
  EXPECT_EQ(hub.viewers(), 0u);
}

TEST(WebHub, NobodyComesWhenItIsFull) {
  WebHub hub;
  std::vector<ViewerId> all;
  for (size_t i = 0; i < WebHub::kMostViewers; ++i) all.push_back(hub.join(kStart));
  EXPECT_THROW(hub.join(kStart), Error);
  hub.leave(all[3]);
  EXPECT_NO_THROW(hub.join(kStart));
}

TEST(WebHub, WhoSaysTooMuchIsTurnedAway) {
  WebHub hub;
  const ViewerId steady = joined(hub), flood = joined(hub);
  const int rate = static_cast<int>(WebHub::kMostMessages);
  for (int i = 0; i < 10 * rate; ++i)
    EXPECT_NO_THROW(hub.hear(steady, move(1), after(double(i) / rate))) << i;
  int taken = 0;
  EXPECT_THROW(for (;; ++taken) hub.hear(flood, move(1), kStart), Error);
  EXPECT_LE(taken, 2 * rate);
}

TEST(WebHub, WhatMakesNoSenseIsTheViewersFault) {
  WebHub hub;
  const ViewerId id = joined(hub);
  EXPECT_THROW(hub.hear(id, said::Hello{}, kStart), Error);
  EXPECT_THROW(hub.hear(id, said::Shown{}, kStart), Error);
}

TEST(WebHub, AnUpdateMustBeShownInTime) {
  WebHub hub;
  hub.offer(offerOf(picture()));
  const ViewerId id = hub.join(kStart);
  EXPECT_FALSE(hub.isLate(id, after(1000)));
  hub.next(id, kStart);
  EXPECT_FALSE(hub.isLate(id, after(30)));
  EXPECT_TRUE(hub.isLate(id, after(30.1)));
  hub.written(id, after(25));  // a large one, on a thin line
  EXPECT_FALSE(hub.isLate(id, after(55)));
  EXPECT_TRUE(hub.isLate(id, after(55.1)));
}

// Means of 2 x 2 codes: 10 20 30 40 -> 25.
TEST(WebHub, ASmallerPictureHasMeans) {
  DisplayImage codes;
  codes.reshape(5, 2);
  for (size_t c = 0; c < 3; ++c) {
    const auto at = [&](size_t x, size_t y) -> uint8_t& { return codes.rgb[3 * (y * 5 + x) + c]; };
    at(0, 0) = 10, at(1, 0) = 20, at(0, 1) = 30, at(1, 1) = 40;
    at(2, 0) = at(3, 0) = at(2, 1) = 255, at(3, 1) = 254;
    at(4, 0) = at(4, 1) = 7;  // fills no block
  }
  const DisplayImage small = shrunk(codes, 2);
  EXPECT_EQ(small.width, 2);
  EXPECT_EQ(small.height, 1);
  EXPECT_EQ(small.rgb, (std::vector<uint8_t>{25, 25, 25, 255, 255, 255}));
}

}  // namespace
}  // namespace ninefold
