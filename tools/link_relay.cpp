// ninefold-link-relay NAME_A NAME_B [options]: a line between two network namespaces that is slow,
// late, lossy or cut, for kernels without netem.
//
//   namespace A: TUN device --> queue: rate, delay, loss --> TUN device :namespace B   and back
//
// Each direction holds packets until they would have crossed: a packet of b bytes leaves the sender
// b / rate after the one before it, and arrives `delay` later; a queue of more than kQueue seconds
// drops what comes (as a switch does). Loss is by a fixed sequence, the same in every run. With
// --cut T:S nothing passes from T to T + S seconds after the start. Ends at SIGTERM, or when it has
// no devices any more. Needs the right to enter the namespaces.
// Exit status: 0 ended, 1 a failure, 2 wrong usage.
#include <fcntl.h>
#include <linux/if.h>
#include <linux/if_tun.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstring>
#include <deque>
#include <random>

#include "common/base/clock.h"
#include "common/base/descriptor.h"
#include "common/base/error.h"
#include "tools/command.h"

namespace ninefold {
namespace {

namespace po = boost::program_options;

constexpr double kQueue = 0.05;       // [s] of packets at the line's rate
constexpr size_t kMostBytes = 65536;  // of a packet

struct Options {
  std::string a, b, cut;
  double mbit = 0, delayMs = 0, loss = 0;
};

// A TUN device named nfrelay in a namespace of `ip netns`.
Descriptor openTun(const std::string& space) {
  const Descriptor name(::open(("/run/netns/" + space).c_str(), O_RDONLY | O_CLOEXEC));
  if (!name || ::setns(name.get(), CLONE_NEWNET) != 0)
    fail("cannot enter network namespace {}: {}", space, std::strerror(errno));
  Descriptor tun(::open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC));
  ifreq request{};
  request.ifr_flags = IFF_TUN | IFF_NO_PI;
  std::strncpy(request.ifr_name, "nfrelay", IFNAMSIZ - 1);
  if (!tun || ::ioctl(tun.get(), TUNSETIFF, &request) != 0)
    fail("cannot make a TUN device in {}: {}", space, std::strerror(errno));
  return tun;
}

// One direction of the line.
class Direction {
 public:
  Direction(int from, int to, const Options& o, uint32_t seed)
      : from_(from),
        to_(to),
        secondsPerByte_(o.mbit > 0 ? 8e-6 / o.mbit : 0),
        delay_(fromSeconds(1e-3 * o.delayMs)),
        loss_(o.loss / 100),
        random_(seed) {}

  // Takes what the device has.
  void take(Time now, bool cut) {
    std::vector<char> packet(kMostBytes);
    for (ssize_t got; (got = ::read(from_, packet.data(), packet.size())) > 0;) {
      if (cut || std::uniform_real_distribution<double>(0, 1)(random_) < loss_) continue;
      const Time free = std::max(now, lineFree_);
      if (free - now > fromSeconds(kQueue)) continue;
      lineFree_ = free + fromSeconds(static_cast<double>(got) * secondsPerByte_);
      waiting_.push_back({lineFree_ + delay_, {packet.begin(), packet.begin() + got}});
    }
  }
  // Hands over what has crossed. Full devices drop, as lines do.
  void give(Time now) {
    for (; !waiting_.empty() && waiting_.front().due <= now; waiting_.pop_front()) {
      const auto& bytes = waiting_.front().bytes;
      if (::write(to_, bytes.data(), bytes.size()) < 0 && errno == EBADFD)
        fail("the device is gone");
    }
  }
  Time due() const { return waiting_.empty() ? Time::max() : waiting_.front().due; }

 private:
  struct Packet {
    Time due;
    std::vector<char> bytes;
  };
  const int from_, to_;
  const double secondsPerByte_;
  const Duration delay_;
  const double loss_;
  std::mt19937 random_;
  Time lineFree_{};
  std::deque<Packet> waiting_;
};

// Until what is nearest; with the accuracy of ppoll, some ten microseconds.
void waitFor(int a, int b, Time until) {
  pollfd devices[] = {{a, POLLIN, 0}, {b, POLLIN, 0}};
  timespec time{1, 0};
  if (until != Time::max()) {
    const auto left = std::max<int64_t>(
        0, std::chrono::duration_cast<std::chrono::nanoseconds>(until - Clock::now()).count());
    time = {left / 1'000'000'000, left % 1'000'000'000};
  }
  ::ppoll(devices, 2, &time, nullptr);
}

int relay(const Options& o) {
  double cutFrom = 1e30, cutFor = 0;
  if (!o.cut.empty()) {
    const size_t colon = o.cut.find(':');
    if (colon == std::string::npos) failUsage("--cut {}: write START:SECONDS", o.cut);
    cutFrom = parseNumbers("cut", o.cut.substr(0, colon)).front();
    cutFor = parseNumbers("cut", o.cut.substr(colon + 1)).front();
  }
  const Descriptor a = openTun(o.a), b = openTun(o.b);
  Direction there(a.get(), b.get(), o, 1), back(b.get(), a.get(), o, 2);
  writeOutput("ready\n");
  const Time start = Clock::now();
  while (true) {
    waitFor(a.get(), b.get(), std::min(there.due(), back.due()));
    const Time now = Clock::now();
    const double t = seconds(now - start);
    const bool cut = t >= cutFrom && t < cutFrom + cutFor;
    there.take(now, cut), back.take(now, cut);
    there.give(now), back.give(now);
  }
}

int run(int argc, char** argv) {
  Options o;
  Command command{"ninefold-link-relay", "NAMESPACE_A NAMESPACE_B [options]",
                  "A line between two network namespaces that is slow, late, lossy or cut.\n"};
  command.words = {{"NAMESPACE_A", &o.a}, {"NAMESPACE_B", &o.b}};
  command.flags.add_options()("mbit", po::value(&o.mbit),
                              "rate of each direction, default 0: unlimited")(
      "delay-ms", po::value(&o.delayMs), "one way, default 0")("loss", po::value(&o.loss),
                                                               "percent of all packets, default 0")(
      "cut", po::value(&o.cut), "START:SECONDS: nothing passes then");
  if (!parseCommandLine(argc, argv, command)) return 0;
  checkRange("mbit", o.mbit, 0.0, 1e6);
  checkRange("delay-ms", o.delayMs, 0.0, 1e4);
  checkRange("loss", o.loss, 0.0, 100.0);
  return relay(o);
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  return ninefold::runProgram("ninefold-link-relay", [&] { return ninefold::run(argc, argv); });
}
