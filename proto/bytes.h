// bytes.h: raw bytes, and how numbers become bytes: little-endian, field by field, never a cast
// struct.
//
// ByteWriter appends to a buffer. ByteReader walks over one and never beyond its end.
// Errors: ByteReader throws Error that names the field, if bytes are missing or a count is larger
// than what is left can hold. It checks before anything is allocated.
// Threads: plain values.
#pragma once

#include <bit>
#include <boost/core/noinit_adaptor.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/base/error.h"

namespace ninefold {

static_assert(std::endian::native == std::endian::little,
              "the wire is little-endian; add a swap here");

// resize() leaves new bytes unset: callers overwrite them, and zeroing would cost.
using Bytes = std::vector<std::byte, boost::noinit_adaptor<std::allocator<std::byte>>>;
using ByteView = std::span<const std::byte>;

inline ByteView viewOf(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

inline std::string_view textOf(ByteView bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class ByteWriter {
 public:
  explicit ByteWriter(Bytes& out) : out_(out) {}

  template <typename T>
  void number(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    raw(&value, sizeof value);
  }
  void raw(const void* data, size_t size) {
    const auto* bytes = static_cast<const std::byte*>(data);
    out_.insert(out_.end(), bytes, bytes + size);
  }

 private:
  Bytes& out_;
};

class ByteReader {
 public:
  // `what` names the source in errors, e.g. "scene blob".
  ByteReader(ByteView in, const char* what) : in_(in), what_(what) {}

  template <typename T>
  T number(const char* field) {
    static_assert(std::is_arithmetic_v<T>);
    T value;
    raw(&value, sizeof value, field);
    return value;
  }
  void raw(void* data, size_t size, const char* field) {
    need(size, field);
    if (size > 0) std::memcpy(data, in_.data(), size);
    in_ = in_.subspan(size);
  }
  // Checks a number of things, each of at least `bytesEach` > 0 of the remaining bytes.
  size_t count(uint64_t claimed, size_t bytesEach, const char* field) const {
    if (claimed > in_.size() / bytesEach)
      fail("{}: {} claims {} entries, more than the data holds; it is damaged", what_, field,
           claimed);
    return static_cast<size_t>(claimed);
  }
  ByteView take(size_t size, const char* field) {
    need(size, field);
    const ByteView taken = in_.first(size);
    in_ = in_.subspan(size);
    return taken;
  }
  size_t left() const { return in_.size(); }
  const char* what() const { return what_; }
  void expectEnd() const {
    if (!in_.empty()) fail("{}: {} bytes too many; it is damaged", what_, in_.size());
  }

 private:
  void need(size_t size, const char* field) const {
    if (in_.size() < size) fail("{}: ends inside {}; it is damaged", what_, field);
  }
  ByteView in_;
  const char* what_;
};

// As ByteReader, over bytes that the reader may change where they lie.
class MutableReader {
 public:
  MutableReader(std::span<std::byte> in, const char* what) : in_(in), reader_(in, what) {}

  template <typename T>
  T number(const char* field) {
    return reader_.number<T>(field);
  }
  std::span<uint8_t> take(size_t size, const char* field) {
    const size_t at = in_.size() - reader_.left();
    reader_.take(size, field);
    return {reinterpret_cast<uint8_t*>(in_.data()) + at, size};
  }
  const char* what() const { return reader_.what(); }
  void expectEnd() const { reader_.expectEnd(); }

 private:
  std::span<std::byte> in_;
  ByteReader reader_;
};

}  // namespace ninefold
