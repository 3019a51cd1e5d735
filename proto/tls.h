// tls.h: TLS 1.3 with a pre-shared key, as a machine without a socket: encrypted bytes in and out,
// plain bytes in and out. Internal to the connection.
//
// There are no certificates: both sides know a 32-byte key. TLS gets a key derived from it,
//
//   psk = HKDF-SHA256(key, info = "ninefold 1: client dials, master listens: " use)
//   use = "local" | "cluster"
//
// so that a key works in one role and for one use only. The key exchange is always ephemeral
// (psk_dhe_ke, X25519 or P-256): recorded traffic stays closed if the key is lost later. Tickets,
// early data, renegotiation and older versions are off.
// Sources: RFC 8446 (TLS 1.3), RFC 5869 (HKDF), RFC 9257 (external PSKs: bind roles).
// Errors: TlsError.   Threads: a session belongs to one thread; contexts are shared read-only.
#pragma once

#include <memory>

#include "proto/bytes.h"
#include "proto/key.h"

namespace ninefold {

class TlsError : public Error {
 public:
  enum class Kind : uint8_t {
    wrongKey,  // speaks our TLS, but does not hold the key
    foreign,   // not a Ninefold peer
    broken,    // after the handshake: somebody damaged the stream
  };
  TlsError(Kind kind, const std::string& line) : Error(line), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

// What sessions of one side have in common: settings and derived keys (wiped at the end).
class TlsContext {
 public:
  // `cluster` may be null: then clients that come with the cluster key are refused.
  static std::shared_ptr<const TlsContext> forMaster(const Key& local, const Key* cluster);
  static std::shared_ptr<const TlsContext> forClient(KeyUse use, const Key& key);

  struct Impl;
  explicit TlsContext(std::unique_ptr<Impl> impl);
  ~TlsContext();
  Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

class TlsSession {
 public:
  explicit TlsSession(std::shared_ptr<const TlsContext> context);
  ~TlsSession();

  // Encrypted bytes that came from the peer. They are not copied: they must stay where they are
  // until handshake() or read() has asked for more.
  void receive(ByteView encrypted);
  // Goes on with the handshake; true when it is done, false when it needs more from the peer.
  bool handshake();
  // Plain bytes from the peer; 0 = more encrypted bytes are needed, or ended().
  size_t read(std::span<std::byte> into);
  bool ended() const;  // the peer has closed its side in order
  void write(ByteView plain);
  // Encrypts what follows with a fresh key; AES-GCM wants that after some 2^24 records.
  void renewKeys();
  void end();  // tells the peer that nothing more will be written

  // Encrypted bytes for the peer, also after an error (they tell the peer why): swap or clear them.
  Bytes& output();
  KeyUse keyUse() const;  // after the handshake

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace ninefold
