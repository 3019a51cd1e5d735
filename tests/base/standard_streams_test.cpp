// What is said to people may get lost and kills nothing; a result arrives or is an error.
#include "common/base/standard_streams.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <string>

#include "common/base/clock.h"
#include "common/base/command_line.h"
#include "common/base/error.h"
#include "common/base/process.h"
#include "common/base/program.h"

namespace ninefold {
namespace {

// In a process of its own, with the signals' usual effects: its exit status, or minus the signal
// that ended it.
int statusOf(const std::function<int()>& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGPIPE, SIG_DFL);
    ::signal(SIGXFSZ, SIG_DFL);
    _exit(action());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

void becomes(int stream, const Descriptor& other) { ::dup2(other.get(), stream); }

TEST(StandardStreams, ALineWithoutAReaderKillsNothing) {
  EXPECT_EQ(statusOf([] {
              Pipe pipe = makePipe();
              pipe.readEnd.reset();
              becomes(STDERR_FILENO, pipe.writeEnd);
              sayToPeople("nobody reads this\n");
              return 7;
            }),
            7);
}

TEST(StandardStreams, TheSignalOfALostReaderIsGoneAndOneFromElsewhereStillCounts) {
  EXPECT_EQ(statusOf([] {
              static volatile sig_atomic_t came = 0;
              ::signal(SIGPIPE, [](int) { came = came + 1; });
              Pipe pipe = makePipe();
              pipe.readEnd.reset();
              becomes(STDERR_FILENO, pipe.writeEnd);
              sayToPeople("nobody reads this\n");
              const int afterTheLine = came;
              ::kill(::getpid(), SIGPIPE);
              return 10 * afterTheLine + came;
            }),
            1);
}

TEST(StandardStreams, ALineForAFullPipeIsNotWaitedFor) {
  EXPECT_EQ(statusOf([] {
              const Pipe pipe = makePipe();
              becomes(STDERR_FILENO, pipe.writeEnd);
              ::fcntl(STDERR_FILENO, F_SETFL, O_NONBLOCK);
              while (::write(STDERR_FILENO, "x", 1) == 1) continue;
              ::fcntl(STDERR_FILENO, F_SETFL, 0);
              ::alarm(20);
              sayToPeople(std::string(100'000, 'y'));
              return 7;
            }),
            7);
}

TEST(StandardStreams, AFullDiskLosesALineAndFailsAResult) {
  EXPECT_EQ(statusOf([] {
              const Descriptor full(::open("/dev/full", O_WRONLY));
              becomes(STDERR_FILENO, full);
              becomes(STDOUT_FILENO, full);
              sayToPeople("lost\n");
              return runProgram("test", [] { return writeOutput("figures\n"), 0; });
            }),
            1);
}

TEST(StandardStreams, AResultWithoutAReaderFails) {
  EXPECT_EQ(statusOf([] {
              Pipe pipe = makePipe();
              pipe.readEnd.reset();
              becomes(STDOUT_FILENO, pipe.writeEnd);
              return runProgram("test", [] { return writeOutput("figures\n"), 0; });
            }),
            1);
}

TEST(StandardStreams, NoFileTakesThePlaceOfAStreamThatWasClosed) {
  EXPECT_EQ(statusOf([] {
              ::close(0), ::close(1), ::close(2);
              prepareStreams();
              const int file = ::open("/dev/null", O_WRONLY);
              sayToPeople("lost\n");
              try {
                writeOutput("figures\n");
                return 100;
              } catch (const Error&) {
                return file > STDERR_FILENO ? 0 : 101;
              }
            }),
            0);
}

TEST(Program, ExceptionsBecomeAStatusAndALine) {
  const auto run = [](const std::function<int()>& program, const char* line) {
    testing::internal::CaptureStderr();
    const int status = runProgram("ninefold-x", program);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), line);
    return status;
  };
  EXPECT_EQ(run([] { return 130; }, ""), 130);
  EXPECT_EQ(run([]() -> int { failUsage("--size: bad"); }, "ninefold-x: --size: bad\n"), 2);
  EXPECT_EQ(run([]() -> int { fail("disk is full"); }, "ninefold-x: disk is full\n"), 1);
  EXPECT_EQ(run([]() -> int { throw std::runtime_error("no memory"); }, "ninefold-x: no memory\n"),
            1);
}

}  // namespace
}  // namespace ninefold
