// ninefold-master: renders a scene on a cluster of clients.
#include <cstdio>
#include <thread>

#include "master/headless.h"
#include "master/script_run.h"
#include "master/window/session.h"
#include "proto/key.h"

namespace ninefold {
namespace {

int run(const Options& options) {
  if (options.help) {
    std::fputs(helpText().c_str(), stdout);
    return 0;
  }
  if (options.newKey) {
    createKeyFile(*options.newKey);
    return 0;
  }
  if (options.window) return runWindow(options);
  if (isLive(options)) return runScript(options);
  return runHeadless(options);
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  using namespace ninefold;
  try {
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    return run(parseOptions(argc, argv, processVariable, cores));
  } catch (const UsageError& error) {
    std::fprintf(stderr, "ninefold-master: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ninefold-master: %s\n", error.what());
    return 1;
  }
}
