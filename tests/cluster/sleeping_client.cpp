// sleeping-client: a client like any other, but that one of its tasks sleeps: what a native call
// that does not return looks like from outside. For tests/cluster/stuck_test.py. Options: those of
// ninefold-client, and in the environment
//
//   SLEEPER_AFTER   tasks that are done before the one that sleeps
//   SLEEPER_FOR     seconds that it sleeps; none: for ever
//   SLEEPER_GRACE   seconds beyond what the master allows, before the watchdog ends the process;
//                   may be below 0; none: as the real client's
#include <sys/prctl.h>

#include <csignal>
#include <cstdlib>
#include <thread>

#include "client/identity.h"
#include "client/program.h"
#include "common/base/log.h"

namespace ninefold::client {
namespace {

std::optional<double> variable(const char* name) {
  const auto text = processVariable(name);
  return text ? std::optional(std::stod(*text)) : std::nullopt;
}

Rig sleepingRig() {
  Rig rig;
  if (const auto grace = variable("SLEEPER_GRACE")) rig.grace = fromSeconds(*grace);
  const auto done = std::make_shared<std::atomic<int>>(0);
  rig.beforeTask = [done](const FrameKey&, const msg::TaskItem&) {
    if ((*done)++ != static_cast<int>(variable("SLEEPER_AFTER").value_or(0))) return;
    std::this_thread::sleep_for(fromSeconds(variable("SLEEPER_FOR").value_or(1e6)));
  };
  return rig;
}

int run(const Options& options) {
  if (options.local()) ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  nameLog(options.local() ? "client " + options.name : "client");
  const auto key = std::make_shared<const Key>(options.local() ? Key::receive(options.keyDescriptor)
                                                               : Key::load(*options.keyFile));
  EventLoop loop;
  Program program(loop, options, introduce(options), key, std::nullopt, sleepingRig());
  const int status = program.run();
  std::fflush(nullptr);
  std::_Exit(status);  // a worker sleeps
}

}  // namespace
}  // namespace ninefold::client

int main(int argc, char** argv) {
  using namespace ninefold;
  return client::run(client::parseOptions(argc, argv, processVariable, 1));
}
