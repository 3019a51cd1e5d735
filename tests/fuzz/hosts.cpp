// Any bytes as the small files of a cluster, those of --hosts and --master-file: an Error, or what
// ssh and connect may be given.
#include <algorithm>

#include "client/master_address.h"
#include "common/base/error.h"
#include "master/serving/host_clients.h"
#include "tests/fuzz/fuzz.h"

namespace ninefold {
namespace {

void readAsHosts(std::string_view text) {
  const std::vector<Host> hosts = parseHosts(text, "hosts");
  NINEFOLD_CHECK(!hosts.empty() && hosts.size() <= kMostHosts);
  for (const Host& host : hosts) {
    NINEFOLD_CHECK(!host.name.empty() && !host.name.starts_with('-'));
    NINEFOLD_CHECK(std::ranges::all_of(host.name, [](char c) { return c > ' ' && c < 127; }));
  }
}

void readAsAddresses(std::string_view text) {
  for (const Endpoint& at : client::parseAddresses(text, "addresses"))
    NINEFOLD_CHECK(parseEndpoint(addressText(at), "again").host == at.host);
}

template <typename Read>
void attempt(const Read& read, std::string_view text) {
  try {
    read(text);
  } catch (const Error&) {
  }
}

}  // namespace
}  // namespace ninefold

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  std::vector<std::vector<uint8_t>> seeds;
  for (const std::string_view text :
       {"render1\nuser@render2 /opt/bin/ninefold-client # fast\n\nssh://u@h:22\n",
        "10.0.0.1:4700\n[fd00::1]:4701\nrender1:1\n", "# nothing\n", "[[0:1]]:701"})
    seeds.emplace_back(text.begin(), text.end());
  return seeds;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  ninefold::attempt(ninefold::readAsHosts, text);
  ninefold::attempt(ninefold::readAsAddresses, text);
  return 0;
}
