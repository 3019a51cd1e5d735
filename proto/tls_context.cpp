#include "proto/tls_context.h"

#include <openssl/core_names.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/kdf.h>
#include <openssl/params.h>

#include <algorithm>
#include <string_view>

namespace ninefold {
namespace {

constexpr char kCipher[] = "TLS_AES_128_GCM_SHA256";
constexpr unsigned char kCipherId[] = {0x13, 0x01};  // the same one in the handshake's numbers
constexpr char kGroups[] = "X25519:P-256";

std::string_view identityOf(KeyUse use) { return use == KeyUse::local ? "local" : "cluster"; }

void derive(const Key& key, KeyUse use, DerivedKey& out) {
  std::string info = "ninefold 1: client dials, master listens: ";
  info += identityOf(use);
  const std::unique_ptr<EVP_KDF, Freed<EVP_KDF_free>> kdf(EVP_KDF_fetch(nullptr, "HKDF", nullptr));
  const std::unique_ptr<EVP_KDF_CTX, Freed<EVP_KDF_CTX_free>> ctx(EVP_KDF_CTX_new(kdf.get()));
  char digest[] = "SHA256";
  OSSL_PARAM params[] = {
      OSSL_PARAM_construct_utf8_string(OSSL_KDF_PARAM_DIGEST, digest, 0),
      OSSL_PARAM_construct_octet_string(OSSL_KDF_PARAM_KEY,
                                        const_cast<std::byte*>(key.bytes().data()), Key::kBytes),
      OSSL_PARAM_construct_octet_string(OSSL_KDF_PARAM_INFO, info.data(), info.size()),
      OSSL_PARAM_construct_end()};
  NINEFOLD_CHECK(EVP_KDF_derive(ctx.get(), out.psk.data(), out.psk.size(), params) == 1);
  out.present = true;
}

// A "session to resume" is how OpenSSL takes an external key. Null if OpenSSL has no memory.
SSL_SESSION* sessionOf(SSL* ssl, const DerivedKey& key) {
  std::unique_ptr<SSL_SESSION, Freed<SSL_SESSION_free>> session(SSL_SESSION_new());
  const SSL_CIPHER* cipher = SSL_CIPHER_find(ssl, kCipherId);
  const bool made =
      session != nullptr && cipher != nullptr &&
      SSL_SESSION_set1_master_key(session.get(), key.psk.data(), key.psk.size()) == 1 &&
      SSL_SESSION_set_cipher(session.get(), cipher) == 1 &&
      SSL_SESSION_set_protocol_version(session.get(), TLS1_3_VERSION) == 1;
  return made ? session.release() : nullptr;
}

// The master looks up the key by the identity that the client names. Unknown ones are no error of
// OpenSSL's: it then goes on to certificates, has none, and fails.
int findSession(SSL* ssl, const unsigned char* identity, size_t length, SSL_SESSION** session) {
  auto& self = *static_cast<TlsSession::Impl*>(SSL_get_app_data(ssl));
  *session = nullptr;
  const std::string_view named(reinterpret_cast<const char*>(identity), length);
  for (const KeyUse use : {KeyUse::local, KeyUse::cluster}) {
    const DerivedKey& key = self.context->impl().keys[static_cast<size_t>(use)];
    if (named != identityOf(use) || !key.present) continue;
    self.use = use;
    *session = sessionOf(ssl, key);
    return *session != nullptr ? 1 : 0;
  }
  self.unknownIdentity = true;
  return 1;
}

int useSession(SSL* ssl, const EVP_MD*, const unsigned char** identity, size_t* length,
               SSL_SESSION** session) {
  auto& self = *static_cast<TlsSession::Impl*>(SSL_get_app_data(ssl));
  const std::string_view named = identityOf(self.use);
  *identity = reinterpret_cast<const unsigned char*>(named.data());
  *length = named.size();
  *session = sessionOf(ssl, self.context->impl().keys[static_cast<size_t>(self.use)]);
  return *session != nullptr ? 1 : 0;
}

// The pipe: OpenSSL reads from the session's `in` and writes to its `out`; neither ever blocks.
int pipeRead(BIO* bio, char* to, int size) {
  auto& self = *static_cast<TlsSession::Impl*>(BIO_get_data(bio));
  BIO_clear_retry_flags(bio);
  if (self.in.empty()) {
    BIO_set_retry_read(bio);
    return -1;
  }
  const size_t count = std::min(self.in.size(), static_cast<size_t>(size));
  std::memcpy(to, self.in.data(), count);
  self.in = self.in.subspan(count);
  return static_cast<int>(count);
}

int pipeWrite(BIO* bio, const char* from, int size) {
  auto& self = *static_cast<TlsSession::Impl*>(BIO_get_data(bio));
  const auto* bytes = reinterpret_cast<const std::byte*>(from);
  self.out.insert(self.out.end(), bytes, bytes + size);
  return size;
}

long pipeControl(BIO*, int command, long, void*) { return command == BIO_CTRL_FLUSH ? 1 : 0; }

std::unique_ptr<TlsContext::Impl> makeContext(bool master) {
  auto made = std::make_unique<TlsContext::Impl>();
  made->master = master;
  made->ctx.reset(SSL_CTX_new(master ? TLS_server_method() : TLS_client_method()));
  SSL_CTX* ctx = made->ctx.get();
  NINEFOLD_CHECK(ctx != nullptr);
  NINEFOLD_CHECK(SSL_CTX_set_min_proto_version(ctx, TLS1_3_VERSION) == 1);
  NINEFOLD_CHECK(SSL_CTX_set_ciphersuites(ctx, kCipher) == 1);
  NINEFOLD_CHECK(SSL_CTX_set1_groups_list(ctx, kGroups) == 1);
  NINEFOLD_CHECK(SSL_CTX_set_num_tickets(ctx, 0) == 1);
  SSL_CTX_set_session_cache_mode(ctx, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_options(ctx, SSL_OP_NO_TICKET | SSL_OP_NO_RENEGOTIATION);
  // There is no authority: a server that shows a certificate instead of knowing the key always
  // fails.
  SSL_CTX_set_verify(ctx, master ? SSL_VERIFY_NONE : SSL_VERIFY_PEER, nullptr);
  if (master)
    SSL_CTX_set_psk_find_session_callback(ctx, findSession);
  else
    SSL_CTX_set_psk_use_session_callback(ctx, useSession);
  made->pipe.reset(BIO_meth_new(BIO_get_new_index() | BIO_TYPE_SOURCE_SINK, "ninefold"));
  BIO_meth_set_read(made->pipe.get(), pipeRead);
  BIO_meth_set_write(made->pipe.get(), pipeWrite);
  BIO_meth_set_ctrl(made->pipe.get(), pipeControl);
  return made;
}

}  // namespace

DerivedKey::~DerivedKey() { OPENSSL_cleanse(psk.data(), psk.size()); }

TlsContext::TlsContext(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TlsContext::~TlsContext() = default;

std::shared_ptr<const TlsContext> TlsContext::forMaster(const Key& local, const Key* cluster) {
  auto made = makeContext(true);
  derive(local, KeyUse::local, made->keys[static_cast<size_t>(KeyUse::local)]);
  if (cluster != nullptr)
    derive(*cluster, KeyUse::cluster, made->keys[static_cast<size_t>(KeyUse::cluster)]);
  return std::make_shared<TlsContext>(std::move(made));
}

std::shared_ptr<const TlsContext> TlsContext::forClient(KeyUse use, const Key& key) {
  auto made = makeContext(false);
  made->use = use;
  derive(key, use, made->keys[static_cast<size_t>(use)]);
  return std::make_shared<TlsContext>(std::move(made));
}

}  // namespace ninefold
