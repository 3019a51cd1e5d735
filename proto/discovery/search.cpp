#include "proto/discovery/search.h"

#include <avahi-client/client.h>
#include <avahi-client/lookup.h>
#include <avahi-common/error.h>
#include <avahi-common/malloc.h>
#include <avahi-common/simple-watch.h>

#include <array>
#include <map>
#include <memory>

#include "common/base/error.h"
#include "proto/text.h"

namespace ninefold {
namespace {

constexpr int kLook = 100;            // [ms]
constexpr size_t kMostPending = 256;  // answers that are waited for

std::string releaseOf(AvahiStringList* texts) {
  AvahiStringList* entry = avahi_string_list_find(texts, kReleaseKey);
  char* value = nullptr;
  if (entry == nullptr || avahi_string_list_get_pair(entry, nullptr, &value, nullptr) < 0 ||
      value == nullptr)
    return "unknown";
  const std::unique_ptr<char, void (*)(void*)> owned(value, avahi_free);
  return printable(value, kMaxText);
}

// Of no use without the interface that it belongs to.
bool isLinkLocal(const AvahiAddress& address) {
  return address.proto == AVAHI_PROTO_INET6 && address.data.ipv6.address[0] == 0xfe &&
         (address.data.ipv6.address[1] & 0xc0) == 0x80;
}

// One look at the network; its callbacks run inside run().
class Search {
 public:
  Search() : poll_(avahi_simple_poll_new(), avahi_simple_poll_free) {
    int error = 0;
    client_.reset(avahi_client_new(avahi_simple_poll_get(poll_.get()), AvahiClientFlags(0),
                                   onClient, this, &error));
    if (!client_) failWith(error);
    // The client's, and ended with it.
    if (avahi_service_browser_new(client_.get(), AVAHI_IF_UNSPEC, AVAHI_PROTO_UNSPEC, kServiceType,
                                  nullptr, AvahiLookupFlags(0), onBrowser, this) == nullptr)
      failWith(avahi_client_errno(client_.get()));
  }

  std::vector<FoundMaster> run() {
    const Time end = Clock::now() + kLongestSearch;
    while (!(isAll_ && pending_ == 0) && Clock::now() < end)
      if (avahi_simple_poll_iterate(poll_.get(), kLook) != 0) break;
    if (error_ != AVAHI_OK) failWith(error_);
    std::vector<FoundMaster> all;
    for (auto& [name, master] : found_) all.push_back(std::move(master));
    return all;
  }

 private:
  [[noreturn]] static void failWith(int error) {
    fail(
        "cannot look for masters on this network: {}; is avahi-daemon running here? Else give "
        "--master ADDR:PORT",
        avahi_strerror(error));
  }

  static void onClient(AvahiClient* client, AvahiClientState state, void* self) {
    auto& search = *static_cast<Search*>(self);
    if (state == AVAHI_CLIENT_FAILURE) search.end(avahi_client_errno(client));
  }

  static void onBrowser(AvahiServiceBrowser* browser, AvahiIfIndex interface,
                        AvahiProtocol protocol, AvahiBrowserEvent event, const char* name,
                        const char* type, const char* domain, AvahiLookupResultFlags, void* self) {
    auto& search = *static_cast<Search*>(self);
    AvahiClient* client = avahi_service_browser_get_client(browser);
    if (event == AVAHI_BROWSER_FAILURE) search.end(avahi_client_errno(client));
    if (event == AVAHI_BROWSER_ALL_FOR_NOW) search.isAll_ = true;
    if (event != AVAHI_BROWSER_NEW || search.pending_ >= kMostPending) return;
    const bool isAsked =
        avahi_service_resolver_new(client, interface, protocol, name, type, domain, protocol,
                                   AvahiLookupFlags(0), onAnswer, self) != nullptr;
    search.pending_ += isAsked ? 1 : 0;
  }

  static void onAnswer(AvahiServiceResolver* resolver, AvahiIfIndex, AvahiProtocol,
                       AvahiResolverEvent event, const char* name, const char*, const char*,
                       const char*, const AvahiAddress* address, uint16_t port,
                       AvahiStringList* texts, AvahiLookupResultFlags, void* self) {
    auto& search = *static_cast<Search*>(self);
    --search.pending_;
    if (event == AVAHI_RESOLVER_FOUND && !isLinkLocal(*address))
      search.keep(name, *address, port, releaseOf(texts));
    avahi_service_resolver_free(resolver);
  }

  void keep(const std::string& name, const AvahiAddress& address, uint16_t port,
            std::string release) {
    const auto known = found_.find(name);
    if (known == found_.end() && found_.size() >= kMostFound) return;
    if (known != found_.end() && address.proto == AVAHI_PROTO_INET6) return;
    std::array<char, AVAHI_ADDRESS_STR_MAX> text{};
    avahi_address_snprint(text.data(), text.size(), &address);
    found_[name] = {printable(name, kMaxText), std::move(release), {text.data(), port}};
  }

  void end(int error) {
    error_ = error;
    avahi_simple_poll_quit(poll_.get());
  }

  const std::unique_ptr<AvahiSimplePoll, void (*)(AvahiSimplePoll*)> poll_;
  std::unique_ptr<AvahiClient, void (*)(AvahiClient*)> client_{nullptr, avahi_client_free};
  std::map<std::string, FoundMaster> found_;
  size_t pending_ = 0;
  bool isAll_ = false;
  int error_ = AVAHI_OK;
};

}  // namespace

std::vector<FoundMaster> findMasters() { return Search().run(); }

}  // namespace ninefold
