// tls_context.h: OpenSSL's side of tls.h, shared by tls_context.cpp and tls_session.cpp.
#pragma once

#include <openssl/bio.h>
#include <openssl/ssl.h>

#include <array>

#include "proto/tls.h"

namespace ninefold {

template <auto free>
struct Freed {
  template <typename T>
  void operator()(T* object) const {
    free(object);
  }
};

// The key that TLS sees for one use; absent uses are refused.
struct DerivedKey {
  bool present = false;
  std::array<unsigned char, 32> psk{};
  ~DerivedKey();
};

struct TlsContext::Impl {
  std::unique_ptr<SSL_CTX, Freed<SSL_CTX_free>> ctx;
  std::unique_ptr<BIO_METHOD, Freed<BIO_meth_free>> pipe;  // reads and writes a TlsSession::Impl
  std::array<DerivedKey, 2> keys;                          // by KeyUse
  bool master = false;
  KeyUse use = KeyUse::local;  // of a client
};

struct TlsSession::Impl {
  std::shared_ptr<const TlsContext> context;
  std::unique_ptr<SSL, Freed<SSL_free>> ssl;
  ByteView in;
  Bytes out;
  bool ended = false;
  bool unknownIdentity = false;
  KeyUse use = KeyUse::local;
};

}  // namespace ninefold
