// ninefold-master: renders a scene on a cluster of clients.
#include <signal.h>

#include <thread>

#include "common/base/process.h"
#include "common/base/program.h"
#include "common/base/release.h"
#include "common/base/standard_streams.h"
#include "master/running/headless.h"
#include "master/running/script_run.h"
#include "master/web/web_session.h"
#include "master/window/session.h"
#include "proto/key.h"

namespace ninefold {
namespace {

int run(const Options& options) {
  if (options.help) {
    writeOutput(helpText());
    return 0;
  }
  if (options.version) {
    writeOutput(versionText("ninefold-master"));
    return 0;
  }
  if (options.newKey) {
    createKeyFile(*options.newKey);
    return 0;
  }
  if (options.window) return runWindow(options);
  if (options.serve) return runWeb(options);
  if (isLive(options)) return runScript(options);
  return runHeadless(options);
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  using namespace ninefold;
  // Who asks too early or too late waits (cluster.h).
  takeSignal(SIGUSR1, false), takeSignal(SIGUSR2, false);
  return runProgram("ninefold-master", [&] {
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    return run(parseOptions(argc, argv, processVariable, cores));
  });
}
