#include "master/serving/host_clients.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>

#include "common/base/descriptor.h"
#include "common/base/error.h"
#include "common/base/read_up_to.h"

namespace ninefold {
namespace {

constexpr size_t kMostBytes = 1 << 20;

// One word for any shell.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) c == '\'' ? word += "'\\''" : word += c;
  return word + "'";
}

bool isPrintable(const std::string& word) {
  return std::ranges::all_of(word, [](char c) { return c > ' ' && c < 127; });
}

// What the host's shell does: it becomes the client.
std::string remoteCommand(const Host& host, const Endpoint& listen, const std::string& isa) {
  const std::string seen =
      "a=${SSH_CONNECTION%% *}; case $a in *:*) a=\"[$a]\";; esac; "
      "exec \"$0\" --master=\"$a:$1\"";
  const std::string given = "exec \"$0\" --master=\"$1\"";
  const bool any = isAnyAddress(listen.host);
  const std::string script =
      (any ? seen : given) + " --name=\"$2\" --isa=\"$3\" --key-descriptor=0";
  const std::string at = any ? std::to_string(listen.port) : addressText(listen);
  return fmt::format("exec sh -c {} {} {} {} {}", quoted(script), quoted(host.program), quoted(at),
                     quoted(host.name), quoted(isa));
}

}  // namespace

std::vector<Host> parseHosts(std::string_view text, const std::filesystem::path& file) {
  std::vector<Host> hosts;
  std::istringstream lines{std::string(text)};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line.substr(0, line.find('#')));
    Host host;
    std::string more;
    if (!(words >> host.name)) continue;
    words >> host.program >> more;
    // A word that begins with - would be an option of ssh.
    if (!more.empty() || host.name.starts_with('-') || !isPrintable(host.name) ||
        !isPrintable(host.program) || host.name.size() > kMaxText)
      fail("{}:{}: write HOST [PROGRAM], as ssh takes HOST", file.string(), number);
    hosts.push_back(std::move(host));
  }
  if (hosts.empty() || hosts.size() > kMostHosts)
    fail("{}: has {} hosts instead of 1 to {}", file.string(), hosts.size(), kMostHosts);
  return hosts;
}

std::vector<Host> readHosts(const std::filesystem::path& file) {
  std::string text(kMostBytes + 1, '\0');
  errno = 0;
  const Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY));
  text.resize(in ? readUpTo(in.get(), std::as_writable_bytes(std::span(text))) : 0);
  if (text.empty() && errno != 0)
    fail("{}: {}; --hosts needs a file with a host a line", file.string(), std::strerror(errno));
  if (text.size() > kMostBytes) fail("{}: is too long for a list of hosts", file.string());
  return parseHosts(text, file);
}

StartedClients::Plan hostPlan(const std::vector<Host>& hosts, std::shared_ptr<const Key> key,
                              const Endpoint& listen, const std::string& isa) {
  StartedClients::Plan plan;
  plan.program = "ssh";
  plan.arguments = {"-T", "-o", "BatchMode=yes", "-o", "ConnectTimeout=10",
                    // A host that is switched off without a word is noticed.
                    "-o", "ServerAliveInterval=5", "-o", "ServerAliveCountMax=3", "--"};
  plan.key = std::move(key);
  for (const Host& host : hosts)
    plan.clients.push_back(
        {host.name, "the client on " + host.name, {host.name, remoteCommand(host, listen, isa)}});
  plan.child = {.inheritedAs = 0, .ownGroup = true};
  plan.forEver = true;
  return plan;
}

}  // namespace ninefold
