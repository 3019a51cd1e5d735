// ninefold-client: renders for a master. Builds everything and passes references.
#include <sys/prctl.h>

#include <csignal>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>

#include "client/identity.h"
#include "client/program.h"
#include "common/base/log.h"

namespace ninefold::client {
namespace {

// Whatever ends the master ends its local clients, even one that is stopped.
void dieWithTheMaster() { ::prctl(PR_SET_PDEATHSIG, SIGKILL); }

std::shared_ptr<const Key> takeKey(const Options& options) {
  return std::make_shared<const Key>(options.local() ? Key::receive(options.keyDescriptor)
                                                     : Key::load(*options.keyFile));
}

int run(const Options& options) {
  if (options.local()) dieWithTheMaster();
  nameLog(options.local() ? "client " + options.name : "client");
  const auto key = takeKey(options);
  std::optional<BlobCache> cache;
  if (options.cache) cache.emplace(*options.cache);
  EventLoop loop;
  Program program(loop, options, introduce(options), key, std::move(cache));
  const int status = program.run();
  std::fflush(nullptr);
  // Workers may be deep in tasks that nobody waits for any more; all that counts is done.
  std::_Exit(status);
}

}  // namespace
}  // namespace ninefold::client

int main(int argc, char** argv) {
  using namespace ninefold;
  try {
    const client::Options options = client::parseOptions(
        argc, argv, processVariable, static_cast<int>(std::thread::hardware_concurrency()));
    if (!options.help) return client::run(options);
    std::fputs(client::helpText().c_str(), stdout);
    return 0;
  } catch (const UsageError& error) {
    std::fprintf(stderr, "ninefold-client: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ninefold-client: %s\n", error.what());
    return 1;
  }
}
