// ninefold-client: renders for a master. Builds everything and passes references.
#include <sys/prctl.h>

#include <csignal>
#include <cstdlib>
#include <optional>
#include <thread>

#include "client/identity.h"
#include "client/master_search.h"
#include "client/program.h"
#include "common/base/log.h"
#include "common/base/program.h"
#include "common/base/release.h"
#include "common/base/standard_streams.h"

namespace ninefold::client {
namespace {

// Whatever ends the master ends its local clients, even one that is stopped.
void dieWithTheMaster() { ::prctl(PR_SET_PDEATHSIG, SIGKILL); }

std::shared_ptr<const Key> takeKey(const Options& options) {
  return std::make_shared<const Key>(options.local() ? Key::receive(options.keyDescriptor)
                                                     : Key::load(*options.keyFile));
}

// Without one the scene comes from the master each time.
std::optional<BlobCache> openCache(const Options& options) {
  if (!options.cache) return std::nullopt;
  try {
    return std::make_optional<BlobCache>(*options.cache);
  } catch (const Error& error) {
    warn("{}; going on without a cache", error.what());
    return std::nullopt;
  }
}

int print(const std::string& text) {
  writeOutput(text);
  return 0;
}

int run(Options options) {
  if (options.local()) dieWithTheMaster();
  nameLog(options.local() ? "client " + options.name : "client");
  const auto key = takeKey(options);
  if (options.master.empty() && !options.masterFile) options.master = addressText(findOnlyMaster());
  EventLoop loop;
  Program program(loop, options, introduce(options), key, openCache(options));
  const int status = program.run();
  // Workers may be deep in tasks that nobody waits for any more; all that counts is done.
  std::_Exit(status);
}

}  // namespace
}  // namespace ninefold::client

int main(int argc, char** argv) {
  using namespace ninefold;
  return runProgram("ninefold-client", [&] {
    client::Options options = client::parseOptions(
        argc, argv, processVariable, static_cast<int>(std::thread::hardware_concurrency()));
    if (options.help) return client::print(client::helpText());
    if (options.version) return client::print(versionText("ninefold-client"));
    return client::run(std::move(options));
  });
}
