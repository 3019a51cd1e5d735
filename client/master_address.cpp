#include "client/master_address.h"

#include <fcntl.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "common/base/descriptor.h"
#include "common/base/read_up_to.h"

namespace ninefold::client {
namespace {

std::string readFile(const std::filesystem::path& file) {
  const Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (!in)
    fail("address file {}: {}; the master writes it with --address-file", file.string(),
         std::strerror(errno));
  std::string text(MasterAddress::kMostBytes + 1, '\0');
  text.resize(readUpTo(in.get(), std::as_writable_bytes(std::span(text))));
  return text;
}

}  // namespace

std::vector<Endpoint> parseAddresses(std::string_view text, const std::filesystem::path& file) {
  std::vector<Endpoint> addresses;
  const std::string place = "address file " + file.string() + ":";
  if (text.size() > MasterAddress::kMostBytes) fail("{} is too long for addresses", place);
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    if (end > kMaxText) fail("{} has a line of {} bytes", place, end);
    if (end > 0) addresses.push_back(parseEndpoint(text.substr(0, end), place));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (addresses.empty() || addresses.size() > MasterAddress::kMostAddresses)
    fail("{} has {} addresses instead of 1 to {}", place, addresses.size(),
         MasterAddress::kMostAddresses);
  return addresses;
}

Endpoint MasterAddress::next() {
  if (const auto* only = std::get_if<Endpoint>(&where_)) return *only;
  const auto& file = std::get<std::filesystem::path>(where_);
  const std::vector<Endpoint> addresses = parseAddresses(readFile(file), file);
  return addresses[turn_++ % addresses.size()];
}

}  // namespace ninefold::client
