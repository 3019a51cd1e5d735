// process.h: programs that we start and end, and descriptors that they inherit.
//
// ChildProcess   owns a running program. Its destructor ends and reaps it, so none is left behind.
//
// Threads: one thread owns a ChildProcess and outlives it: a client asks the kernel to be killed
//          when the thread that called start() dies.
// Errors:  Error with the system's reason.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/descriptor.h"

namespace ninefold {

struct Pipe {
  Descriptor readEnd, writeEnd;
};

// A pipe. No child inherits an end unless it is handed over on purpose.
Pipe makePipe();

inline constexpr int kInheritedDescriptor = 3;

// How a child is started.
struct ChildSetup {
  int inheritedAs = kInheritedDescriptor;  // or 0: in place of our standard input
  bool ownGroup = false;  // what happens on our terminal (Ctrl-C) does not reach it
};

class ChildProcess {
 public:
  // Starts `program`, a path, or a name that is looked for in PATH. Of our descriptors the child
  // has standard input, output and error, and `inherited`; nothing else.
  static ChildProcess start(const std::filesystem::path& program,
                            const std::vector<std::string>& arguments, const Descriptor& inherited,
                            ChildSetup setup = {});
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
  // How it ended; nothing while it runs. Does not wait.
  std::optional<Ending> ended();
  void terminate() const;  // SIGTERM, asks it to go

 private:
  explicit ChildProcess(pid_t pid) : pid_(pid) {}
  pid_t pid_ = 0;  // 0 = reaped
};

// The signals that ask a program to end well: Ctrl-C, SIGTERM, a pipe without a reader, and a
// closed terminal (unless whoever started us had that ignored, as nohup does).
std::vector<int> endingSignals();

// Whether this thread, and those that it starts, take the signal. It waits while no thread does.
void takeSignal(int signal, bool take);

// The program `name` in the folder of our own executable.
std::filesystem::path programBesideUs(const std::string& name);

}  // namespace ninefold
