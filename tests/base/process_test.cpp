#include "common/base/process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <string>
#include <thread>

#include "common/base/clock.h"
#include "common/base/error.h"

namespace ninefold {
namespace {

std::string waitForEnd(ChildProcess& child) {
  for (;;) {
    if (const auto how = child.ended()) return how->text;
    std::this_thread::sleep_for(milliseconds(2));
  }
}

std::string readAll(const Descriptor& fd) {
  std::string text;
  char buffer[256];
  for (ssize_t n; (n = ::read(fd.get(), buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<size_t>(n));
  return text;
}

TEST(ChildProcess, SeesTheInheritedDescriptorAndNoOtherOfOurs) {
  Pipe answer = makePipe();
  const Descriptor openForUsOnly(::dup(STDIN_FILENO));  // without close-on-exec, on purpose
  ASSERT_TRUE(openForUsOnly);
  auto child =
      ChildProcess::start("/bin/sh", {"-c", "ls /proc/self/fd | wc -l >&3"}, answer.writeEnd);
  answer.writeEnd.reset();
  // In the pipeline `ls` has 0, 1, 2 and 3 and the one it reads the folder by.
  EXPECT_EQ(readAll(answer.readEnd), "5\n");
  EXPECT_EQ(waitForEnd(child), "exit status 0");
}

TEST(ChildProcess, TellsHowItEnded) {
  const Pipe pipe = makePipe();
  auto failing = ChildProcess::start("/bin/sh", {"-c", "exit 7"}, pipe.readEnd);
  EXPECT_EQ(waitForEnd(failing), "exit status 7");
  auto sleeping = ChildProcess::start("/bin/sleep", {"1000"}, pipe.readEnd);
  EXPECT_FALSE(sleeping.ended());
  sleeping.terminate();
  EXPECT_EQ(waitForEnd(sleeping), "signal 15 (Terminated)");
}

TEST(ChildProcess, LeavesNothingBehindWhenDestroyed) {
  const Pipe pipe = makePipe();
  pid_t pid = 0;
  {
    const auto child = ChildProcess::start("/bin/sleep", {"1000"}, pipe.readEnd);
    pid = child.pid();
    EXPECT_EQ(::kill(pid, 0), 0);
  }
  EXPECT_NE(::kill(pid, 0), 0);
}

TEST(ChildProcess, NamesTheProgramThatCannotBeStarted) {
  const Pipe pipe = makePipe();
  try {
    ChildProcess::start("/nowhere/at-all", {}, pipe.readEnd);
    FAIL() << "started";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at-all"), std::string::npos);
  }
}

}  // namespace
}  // namespace ninefold
