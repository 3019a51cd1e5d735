// vectors.h: eight floats or words at once, for the loops that the compiler does not vectorise by
// itself. Sums, products and comparisons are the language's operators, lane by lane (an extension
// of GCC and Clang). A comparison gives all bits or none in each lane.
//
// The values are those of the same expressions one by one.
// Threads: plain values.
#pragma once

#include <cstdint>
#include <cstring>

namespace ninefold {

inline constexpr int kLanes = 8;
using Floats = float __attribute__((vector_size(4 * kLanes)));
using Words = uint32_t __attribute__((vector_size(4 * kLanes)));
using Mask = int32_t __attribute__((vector_size(4 * kLanes)));

inline Floats floatsAt(const float* from) {
  Floats out;
  std::memcpy(&out, from, sizeof out);
  return out;
}
inline Words wordsAt(const uint32_t* from) {
  Words out;
  std::memcpy(&out, from, sizeof out);
  return out;
}
template <typename Vector, typename T>
void put(const Vector& values, T* to) {
  static_assert(sizeof(T) * kLanes == sizeof values);
  std::memcpy(to, &values, sizeof values);
}

// `value` where the mask is set, else 0; without a branch and without 0 * infinity.
inline Floats masked(Floats value, Mask mask) { return Floats(Mask(value) & mask); }
inline Floats least(Floats a, Floats b) { return b < a ? b : a; }    // as std::min
inline Floats largest(Floats a, Floats b) { return a < b ? b : a; }  // as std::max

}  // namespace ninefold
