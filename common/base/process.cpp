#include "common/base/process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "common/base/error.h"

namespace ninefold {
namespace {

class SpawnFiles {
 public:
  SpawnFiles(int inherited, int as) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, inherited, as);
    posix_spawn_file_actions_addclosefrom_np(&actions_, std::max(as, STDERR_FILENO) + 1);
  }
  ~SpawnFiles() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnFiles(const SpawnFiles&) = delete;
  SpawnFiles& operator=(const SpawnFiles&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

class SpawnAttributes {
 public:
  explicit SpawnAttributes(bool ownGroup) {
    posix_spawnattr_init(&attributes_);
    if (ownGroup) posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

std::string describeStatus(int status) {
  if (WIFEXITED(status)) return fmt::format("exit status {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  return fmt::format("signal {} ({})", signal, strsignal(signal));
}

}  // namespace

Pipe makePipe() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail("cannot make a pipe: {}", ::strerror(errno));
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

ChildProcess ChildProcess::start(const std::filesystem::path& program,
                                 const std::vector<std::string>& arguments,
                                 const Descriptor& inherited, ChildSetup setup) {
  std::string name = program.string();
  std::vector<std::string> texts = arguments;
  std::vector<char*> argv{name.data()};
  for (std::string& text : texts) argv.push_back(text.data());
  argv.push_back(nullptr);

  const SpawnFiles files(inherited.get(), setup.inheritedAs);
  const SpawnAttributes attributes(setup.ownGroup);
  pid_t pid = 0;
  const int error =
      ::posix_spawnp(&pid, name.c_str(), files.get(), attributes.get(), argv.data(), environ);
  if (error != 0) fail("cannot start {}: {}", name, ::strerror(error));
  return ChildProcess(pid);
}

ChildProcess::~ChildProcess() {
  if (pid_ == 0) return;
  ::kill(pid_, SIGKILL);
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) continue;
}

std::optional<ChildProcess::Ending> ChildProcess::ended() {
  int status = 0;
  if (pid_ == 0 || ::waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  pid_ = 0;
  const bool exited = WIFEXITED(status);
  return Ending{exited ? std::optional(WEXITSTATUS(status)) : std::nullopt, describeStatus(status)};
}

void ChildProcess::terminate() const {
  if (pid_ != 0) ::kill(pid_, SIGTERM);
}

std::vector<int> endingSignals() {
  std::vector<int> signals{SIGINT, SIGTERM, SIGPIPE};
  struct sigaction hangUp {};
  ::sigaction(SIGHUP, nullptr, &hangUp);
  if (hangUp.sa_handler != SIG_IGN) signals.push_back(SIGHUP);
  return signals;
}

void takeSignal(int signal, bool take) {
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, signal);
  ::pthread_sigmask(take ? SIG_UNBLOCK : SIG_BLOCK, &one, nullptr);
}

std::filesystem::path programBesideUs(const std::string& name) {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) fail("cannot find our own program: {}", error.message());
  return self.parent_path() / name;
}

}  // namespace ninefold
