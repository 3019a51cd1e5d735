#include <openssl/err.h>

#include <algorithm>
#include <limits>

#include "proto/tls_context.h"

namespace ninefold {
namespace {

using Kind = TlsError::Kind;

// What the failure of a handshake says about the peer. The first error in OpenSSL's queue is the
// cause.
[[noreturn]] void handshakeFailed(bool master, bool unknownIdentity) {
  const int reason = ERR_GET_REASON(ERR_get_error());
  ERR_clear_error();
  if (master) {
    if (reason == SSL_R_BINDER_DOES_NOT_VERIFY)
      throw TlsError(Kind::wrongKey, "it has another key");
    if (unknownIdentity)
      throw TlsError(Kind::wrongKey, "it names a key that this master does not have");
    throw TlsError(Kind::foreign, "it is not a Ninefold client");
  }
  // How a master says the two sentences above; a handshake failure means that it lacks our kind of
  // key.
  if (reason == SSL_R_TLSV1_ALERT_DECRYPT_ERROR || reason == SSL_R_SSLV3_ALERT_ILLEGAL_PARAMETER ||
      reason == SSL_R_SSLV3_ALERT_HANDSHAKE_FAILURE)
    throw TlsError(Kind::wrongKey, "it does not accept this key");
  throw TlsError(Kind::foreign, "it is not a Ninefold master");
}

[[noreturn]] void streamFailed() {
  ERR_clear_error();
  throw TlsError(Kind::broken, "the encrypted stream is damaged");
}

int clampToInt(size_t size) {
  return static_cast<int>(std::min<size_t>(size, std::numeric_limits<int>::max()));
}

}  // namespace

TlsSession::TlsSession(std::shared_ptr<const TlsContext> context)
    : impl_(std::make_unique<Impl>()) {
  TlsContext::Impl& shared = context->impl();
  impl_->context = std::move(context);
  impl_->use = shared.use;
  impl_->ssl.reset(SSL_new(shared.ctx.get()));
  BIO* pipe = BIO_new(shared.pipe.get());
  NINEFOLD_CHECK(impl_->ssl != nullptr);
  NINEFOLD_CHECK(pipe != nullptr);
  BIO_set_data(pipe, impl_.get());
  BIO_set_init(pipe, 1);
  SSL* ssl = impl_->ssl.get();
  SSL_set_bio(ssl, pipe, pipe);  // which now owns it
  SSL_set_app_data(ssl, impl_.get());
  if (shared.master)
    SSL_set_accept_state(ssl);
  else
    SSL_set_connect_state(ssl);
}

TlsSession::~TlsSession() = default;

void TlsSession::receive(ByteView encrypted) {
  NINEFOLD_CHECK(impl_->in.empty());
  impl_->in = encrypted;
}

bool TlsSession::handshake() {
  ERR_clear_error();
  const int result = SSL_do_handshake(impl_->ssl.get());
  if (result == 1) {
    // Nothing but the shared key lets a peer in, whatever else OpenSSL would have accepted.
    if (SSL_session_reused(impl_->ssl.get()) == 1) return true;
    throw TlsError(Kind::foreign, "it did not use a shared key");
  }
  if (SSL_get_error(impl_->ssl.get(), result) == SSL_ERROR_WANT_READ) return false;
  handshakeFailed(impl_->context->impl().master, impl_->unknownIdentity);
}

size_t TlsSession::read(std::span<std::byte> into) {
  ERR_clear_error();
  const int got = SSL_read(impl_->ssl.get(), into.data(), clampToInt(into.size()));
  if (got > 0) return static_cast<size_t>(got);
  const int error = SSL_get_error(impl_->ssl.get(), got);
  if (error == SSL_ERROR_ZERO_RETURN) impl_->ended = true;
  if (error != SSL_ERROR_WANT_READ && error != SSL_ERROR_ZERO_RETURN) streamFailed();
  return 0;
}

bool TlsSession::ended() const { return impl_->ended; }

void TlsSession::write(ByteView plain) {
  if (plain.empty()) return;
  ERR_clear_error();
  size_t written = 0;
  const int result = SSL_write_ex(impl_->ssl.get(), plain.data(), plain.size(), &written);
  if (result != 1 || written != plain.size()) streamFailed();
}

void TlsSession::renewKeys() {
  ERR_clear_error();
  if (SSL_key_update(impl_->ssl.get(), SSL_KEY_UPDATE_NOT_REQUESTED) != 1) streamFailed();
}

void TlsSession::end() {
  ERR_clear_error();
  SSL_shutdown(impl_->ssl.get());
}

Bytes& TlsSession::output() { return impl_->out; }

KeyUse TlsSession::keyUse() const { return impl_->use; }

}  // namespace ninefold
