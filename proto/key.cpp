#include "proto/key.h"

#include <fcntl.h>
#include <openssl/crypto.h>
#include <openssl/rand.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "common/base/descriptor.h"
#include "common/base/read_up_to.h"
#include "common/base/written_file.h"

namespace ninefold {
namespace {

constexpr int kReceiveDeadlineMs = 5000;

std::string systemText() { return std::strerror(errno); }

bool writeAll(int fd, ByteView bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(fd, bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    bytes = bytes.subspan(static_cast<size_t>(put));
  }
  return true;
}

// For master and client alike: a key is made once, and copied.
constexpr const char* kHowItIsMade =
    "it is made once by ninefold-master --new-key FILE, and copied to each client";

std::string remedyFor(int error) {
  if (error == EACCES) return "it must belong to the user who runs this";
  if (error == ENOENT || error == ENOTDIR) return kHowItIsMade;
  return "look at it, or copy the master's again";
}

void checkKeyFile(int fd, const std::filesystem::path& file) {
  struct stat facts {};
  if (::fstat(fd, &facts) != 0) fail("key file {}: {}", file.string(), systemText());
  if (!S_ISREG(facts.st_mode)) fail("key file {}: is not a regular file", file.string());
  if ((facts.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    fail("key file {}: others may use it (mode {:03o}); run: chmod 600 {}", file.string(),
         facts.st_mode & 0777, file.string());
  if (facts.st_size != static_cast<off_t>(Key::kBytes))
    fail("key file {}: has {} bytes instead of {} and is no key; {}", file.string(), facts.st_size,
         Key::kBytes, kHowItIsMade);
}

}  // namespace

Key::Key(Key&& other) noexcept : bytes_(other.bytes_) {
  OPENSSL_cleanse(other.bytes_.data(), kBytes);
}

Key& Key::operator=(Key&& other) noexcept {
  if (this != &other) {
    bytes_ = other.bytes_;
    OPENSSL_cleanse(other.bytes_.data(), kBytes);
  }
  return *this;
}

Key::~Key() { OPENSSL_cleanse(bytes_.data(), kBytes); }

Key Key::random() {
  Key key;
  if (RAND_priv_bytes(reinterpret_cast<unsigned char*>(key.bytes_.data()), kBytes) != 1)
    fail("the system gives no random bytes; no key can be made");
  return key;
}

Key Key::load(const std::filesystem::path& file) {
  // Not blocking: a named pipe in place of the file must not make us wait.
  const Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (!in) {
    const int error = errno;
    fail("key file {}: {}; {}", file.string(), std::strerror(error), remedyFor(error));
  }
  checkKeyFile(in.get(), file);
  Key key;
  if (readUpTo(in.get(), key.bytes_) != kBytes)
    fail("key file {}: cannot be read to its end", file.string());
  return key;
}

Key Key::receive(int descriptor) {
  const Descriptor in(descriptor);
  Key key;
  pollfd ready{in.get(), POLLIN, 0};
  // The launcher has put the whole key into the pipe before it passes it on: one wait is enough.
  if (!in || ::poll(&ready, 1, kReceiveDeadlineMs) != 1 || readUpTo(in.get(), key.bytes_) != kBytes)
    fail("no key came over descriptor {}; local clients are started by ninefold-master",
         descriptor);
  return key;
}

void createKeyFile(const std::filesystem::path& file) {
  const Key key = Key::random();
  writeFile(file, textOf(key.bytes()), {.mode = 0600, .mayReplace = false});
}

int keyPipe(const Key& key) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail("no pipe for a local client's key: {}", systemText());
  Descriptor in(ends[0]);
  const Descriptor out(ends[1]);
  // A new pipe has room for far more than a key: this does not block.
  if (!writeAll(out.get(), key.bytes())) fail("no pipe for a local client's key: {}", systemText());
  return in.release();
}

}  // namespace ninefold
