// What is on the screen at fixed moments, under a clock of the test.
#include "master/running/shots.h"

#include <gtest/gtest.h>

#include <future>
#include <map>

#include "common/base/error.h"

namespace ninefold {
namespace {

const Time kStart = Clock::now();

std::shared_ptr<const Shown> picture(uint32_t number, int openedMs, int completedMs) {
  auto shown = std::make_shared<Shown>();
  shown->frame.order.key.frame = number;
  shown->frame.opened = kStart + milliseconds(openedMs);
  shown->completed = kStart + milliseconds(completedMs);
  shown->frames = 1;
  return shown;
}

TEST(Shots, EachIsOfThePictureThatWasThereAtItsTime) {
  std::map<int, uint32_t> files;
  Shots shots(kStart, 10, 5, [&](int i, const Shown& s) { files[i] = s.frame.order.key.frame; });
  // Pictures 7, 8 and 9 come at -50, 90 and 310 ms; shots are due at 0, 100, 200, 300 and 400 ms.
  const auto first = picture(7, -120, -50), second = picture(8, 20, 90),
             third = picture(9, 95, 310);
  shots.take(kStart + milliseconds(1), first);
  shots.take(kStart + milliseconds(90), first);    // the second comes
  shots.take(kStart + milliseconds(310), second);  // nobody has looked since; the third comes
  shots.take(kStart + milliseconds(5000), third);
  const std::vector<Shot>& taken = shots.finish();
  const std::map<int, uint32_t> expected{{0, 7}, {1, 8}, {2, 8}, {3, 8}, {4, 9}};
  EXPECT_EQ(files, expected);
  ASSERT_EQ(taken.size(), 5u);
  for (const Shot& shot : taken) {
    EXPECT_EQ(shot.frame, expected.at(shot.number));
    EXPECT_FALSE(shot.isLost);
  }
  EXPECT_NEAR(taken[0].shown, -0.05, 1e-9);
  EXPECT_NEAR(taken[4].opened, 0.095, 1e-9);
  EXPECT_NEAR(taken[4].shown, 0.31, 1e-9);
}

TEST(Shots, AreLostRatherThanWaitedFor) {
  std::promise<void> begun, goOn;
  std::vector<int> files;
  constexpr int kMore = 3, kCount = static_cast<int>(Shots::kMostWaiting) + 1 + kMore;
  Shots shots(kStart, 10, kCount, [&](int i, const Shown&) {
    if (i == 0) begun.set_value(), goOn.get_future().wait();
    files.push_back(i);
  });
  const auto shown = picture(1, 0, 0);
  shots.take(kStart, shown);
  begun.get_future().wait();  // its file takes long; the queue is empty
  shots.take(kStart + milliseconds(100 * kCount), shown);
  goOn.set_value();
  const std::vector<Shot>& taken = shots.finish();
  ASSERT_EQ(taken.size(), size_t{kCount});
  for (const Shot& shot : taken) EXPECT_EQ(shot.isLost, shot.number >= kCount - kMore);
  ASSERT_EQ(files.size(), size_t{kCount - kMore});
  for (int i = 0; i < kCount - kMore; ++i) EXPECT_EQ(files[static_cast<size_t>(i)], i);
}

TEST(Shots, TellOfAFileThatCannotBeWritten) {
  int tried = 0;
  Shots shots(kStart, 10, 3, [&](int, const Shown&) {
    ++tried;
    fail("cannot write shot.exr: the disk is full");
  });
  shots.take(kStart + milliseconds(300), picture(1, 0, 0));
  try {
    shots.finish();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "cannot write shot.exr: the disk is full");
  }
  EXPECT_EQ(tried, 1);
}

}  // namespace
}  // namespace ninefold
