// key.h: the cluster key and the one-time key of local clients: 32 random bytes that are wiped when
// they die and never stand in arguments, logs or stats.
//
// Errors: throw Error with one line that names the file and the remedy, never the content.
// Owner: movable, not copyable. Threads: plain value.
#pragma once

#include <array>
#include <filesystem>

#include "proto/bytes.h"

namespace ninefold {

class Key {
 public:
  static constexpr size_t kBytes = 32;

  static Key random();
  // Reads a key file: a regular file of exactly 32 bytes that neither group nor others may touch.
  static Key load(const std::filesystem::path& file);
  // Reads a key from an inherited descriptor and closes it, within a deadline of a few seconds.
  static Key receive(int descriptor);

  Key(Key&&) noexcept;
  Key& operator=(Key&&) noexcept;
  ~Key();

  ByteView bytes() const { return bytes_; }

 private:
  Key() = default;
  std::array<std::byte, kBytes> bytes_{};
};

// Which key two peers share: the one-time key of the clients that the master starts, or the
// cluster's.
enum class KeyUse : uint8_t { local, cluster };

// --new-key: writes 32 random bytes to a new file of mode 0600; refuses to overwrite anything.
void createKeyFile(const std::filesystem::path& file);

// The read end of a pipe that already holds the key, close-on-exec: the launcher passes it to one
// child (clears the flag there or duplicates it) and closes its own. The child calls Key::receive.
int keyPipe(const Key& key);

}  // namespace ninefold
