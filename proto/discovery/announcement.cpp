#include "proto/discovery/announcement.h"

#include <avahi-client/client.h>
#include <avahi-client/publish.h>
#include <avahi-common/alternative.h>
#include <avahi-common/error.h>
#include <avahi-common/malloc.h>
#include <avahi-common/thread-watch.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <unistd.h>

#include <array>

#include "common/base/log.h"
#include "common/base/release.h"
#include "proto/discovery/service.h"

namespace ninefold {
namespace {

// A label of the DNS is no longer.
std::string machineName() {
  std::array<char, 64> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "ninefold-master";
}

std::string textOf(const sockaddr* address) {
  std::array<char, NI_MAXHOST> text{};
  const bool isV6 = address->sa_family == AF_INET6;
  const socklen_t size = isV6 ? sizeof(sockaddr_in6) : sizeof(sockaddr_in);
  const bool isRead =
      ::getnameinfo(address, size, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) == 0;
  return isRead ? text.data() : "";
}

// The interface that has the address; all of them if it stands for all.
AvahiIfIndex interfaceOf(const std::string& host) {
  ifaddrs* first = nullptr;
  if (isAnyAddress(host) || ::getifaddrs(&first) != 0) return AVAHI_IF_UNSPEC;
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> all(first, ::freeifaddrs);
  for (const ifaddrs* i = all.get(); i != nullptr; i = i->ifa_next) {
    const int family = i->ifa_addr == nullptr ? AF_UNSPEC : i->ifa_addr->sa_family;
    if ((family == AF_INET || family == AF_INET6) && textOf(i->ifa_addr) == host)
      return static_cast<AvahiIfIndex>(::if_nametoindex(i->ifa_name));
  }
  return AVAHI_IF_UNSPEC;
}

}  // namespace

// Its callbacks run in Avahi's thread, and the first of them inside create().
class Announcement::Publisher {
 public:
  explicit Publisher(const Endpoint& at)
      : interface_(interfaceOf(at.host)),
        protocol_(at.host.find(':') == std::string::npos ? AVAHI_PROTO_INET : AVAHI_PROTO_UNSPEC),
        port_(at.port),
        name_(machineName()),
        poll_(avahi_threaded_poll_new()) {
    create();
    avahi_threaded_poll_start(poll_);
  }

  ~Publisher() {
    avahi_threaded_poll_stop(poll_);
    if (client_ != nullptr) avahi_client_free(client_);
    avahi_threaded_poll_free(poll_);
  }

 private:
  void create() {
    int error = 0;
    group_ = nullptr;
    client_ = avahi_client_new(avahi_threaded_poll_get(poll_), AVAHI_CLIENT_NO_FAIL, onClient, this,
                               &error);
    if (client_ == nullptr) tell(error);
  }

  static void onClient(AvahiClient* client, AvahiClientState state, void* self) {
    auto& publisher = *static_cast<Publisher*>(self);
    publisher.client_ = client;
    if (state == AVAHI_CLIENT_S_RUNNING) return publisher.publish();
    if (state == AVAHI_CLIENT_CONNECTING) return publisher.tell(AVAHI_ERR_NO_DAEMON);
    if (state != AVAHI_CLIENT_FAILURE) return;
    publisher.tell(avahi_client_errno(client));
    if (avahi_client_errno(client) != AVAHI_ERR_DISCONNECTED) return;
    avahi_client_free(client);  // and all that it has; then waits for the next daemon
    publisher.create();
  }

  static void onGroup(AvahiEntryGroup*, AvahiEntryGroupState state, void* self) {
    auto& publisher = *static_cast<Publisher*>(self);
    if (state == AVAHI_ENTRY_GROUP_COLLISION) publisher.rename();
    if (state == AVAHI_ENTRY_GROUP_FAILURE) publisher.tell(avahi_client_errno(publisher.client_));
    if (state == AVAHI_ENTRY_GROUP_ESTABLISHED)
      log("announced on this network as {}", publisher.name_);
  }

  void publish() {
    if (group_ == nullptr) group_ = avahi_entry_group_new(client_, onGroup, this);
    if (group_ == nullptr) return tell(avahi_client_errno(client_));
    avahi_entry_group_reset(group_);
    const std::string release = std::string(kReleaseKey) + "=" + releaseName();
    int error = avahi_entry_group_add_service(group_, interface_, protocol_, AvahiPublishFlags(0),
                                              name_.c_str(), kServiceType, nullptr, nullptr, port_,
                                              release.c_str(), nullptr);
    if (error == AVAHI_ERR_COLLISION) return rename();  // with another of this machine
    if (error == AVAHI_OK) error = avahi_entry_group_commit(group_);
    if (error != AVAHI_OK) tell(error);
  }

  void rename() {
    char* other = avahi_alternative_service_name(name_.c_str());
    name_ = other;
    avahi_free(other);
    publish();
  }

  // Once: who restarts the daemon knows.
  void tell(int error) {
    if (std::exchange(isTold_, true)) return;
    warn("not announced on this network: {}; is avahi-daemon running here? Clients need --master",
         avahi_strerror(error));
  }

  const AvahiIfIndex interface_;
  const AvahiProtocol protocol_;
  const uint16_t port_;
  std::string name_;
  AvahiThreadedPoll* const poll_;
  AvahiClient* client_ = nullptr;
  AvahiEntryGroup* group_ = nullptr;  // the client's
  bool isTold_ = false;
};

Announcement::Announcement(const Endpoint& listensAt)
    : publisher_(std::make_unique<Publisher>(listensAt)) {}

Announcement::~Announcement() = default;

}  // namespace ninefold
