// process.h: programs that we start and end, and descriptors that they inherit.
//
// UniqueFd       owns a file descriptor.
// ChildProcess   owns a running program: ends and reaps it when destroyed, so that none is left
// behind. Threads: one thread owns a ChildProcess; the kernel's parent-death signal counts for the
// thread that called start, so that thread lives as long as its children.   Errors: Error with the
// system's reason.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ninefold {

class UniqueFd {
 public:
  UniqueFd() = default;
  explicit UniqueFd(int fd) : fd_(fd) {}
  UniqueFd(UniqueFd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  UniqueFd& operator=(UniqueFd&& other) noexcept {
    reset(std::exchange(other.fd_, -1));
    return *this;
  }
  ~UniqueFd() { reset(); }

  int get() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }
  void reset(int fd = -1);
  explicit operator bool() const { return fd_ >= 0; }

 private:
  int fd_ = -1;
};

struct Pipe {
  UniqueFd readEnd, writeEnd;
};

// A pipe of which no child inherits an end, unless it is handed over on purpose.
Pipe makePipe();

class ChildProcess {
 public:
  // Starts `program`. The child sees `inherited` as descriptor kInheritedDescriptor and, besides
  // standard input, output and error, nothing else of ours.
  static ChildProcess start(const std::filesystem::path& program,
                            const std::vector<std::string>& arguments, const UniqueFd& inherited);
  ChildProcess(ChildProcess&& other) noexcept : pid_(std::exchange(other.pid_, 0)) {}
  ChildProcess& operator=(ChildProcess&& other) noexcept {
    std::swap(pid_, other.pid_);
    return *this;
  }
  ~ChildProcess();  // kill -9 and reap, if it still runs

  pid_t pid() const { return pid_; }
  struct Ending {
    std::optional<int> status;  // nothing: a signal
    std::string text;           // "exit status 1", "signal 9 (Killed)"
  };
  // How it ended, once it has; asks without waiting.
  std::optional<Ending> ended();
  void terminate() const;  // SIGTERM, asks it to go

 private:
  explicit ChildProcess(pid_t pid) : pid_(pid) {}
  pid_t pid_ = 0;  // 0 = reaped
};

// The signals that ask a program to end well: Ctrl-C, SIGTERM, a closed terminal (unless whoever
// started us had it ignored, as nohup does), a pipe without a reader.
std::vector<int> endingSignals();

inline constexpr int kInheritedDescriptor = 3;

// The program `name` in the folder of our own executable.
std::filesystem::path programBesideUs(const std::string& name);

}  // namespace ninefold
