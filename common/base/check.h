// check.h: NINEFOLD_CHECK, for our own bugs. It prints the expression, the place and, of a
// comparison, both values; then it aborts.
//
//   NINEFOLD_CHECK(claims == held);
//   internal error: claims == held does not hold (3 and 4) at master/x.cpp:85; please report...
//
// C++ reads `Values() <=> a == b` as `(Values() <=> a) == b`: the first operator keeps a, the
// second compares it with b and keeps b, too. Each side is evaluated once.
// Of `a == b && c` only the truth is known: better two checks. A value without a text is a "?".
// Threads: any thread.
#pragma once

#include <fmt/core.h>

#include <concepts>
#include <string>
#include <type_traits>
#include <utility>

namespace ninefold {

// `values`: both sides of a comparison as text; empty of anything else.
[[noreturn]] void checkFailed(const char* expression, const std::string& values, const char* file,
                              int line);

namespace check {

template <typename T>
std::string show(const T& value) {
  if constexpr (std::is_null_pointer_v<T> || std::is_pointer_v<T>)
    return value == nullptr ? "null" : "not null";
  else if constexpr (std::is_enum_v<T>)
    return show(+static_cast<std::underlying_type_t<T>>(value));
  else if constexpr (fmt::is_formattable<T>::value)
    return fmt::format("{}", value);
  else if constexpr (requires { value.has_value(); })
    return value.has_value() ? show(*value) : "nothing";
  else if constexpr (requires { value.time_since_epoch(); })
    return show(value.time_since_epoch());
  else if constexpr (requires { value.count(); })
    return show(value.count());
  else
    return "?";
}

// These are compared by value, whatever their signedness: a literal is an int.
template <typename T>
concept Integer = std::integral<T> && !std::same_as<T, bool> && !std::same_as<T, char>;

template <typename L, typename R>
struct Comparison {
  bool holds;
  const L& left;
  const R& right;
  explicit operator bool() const { return holds; }
  std::string values() const { return show(left) + " and " + show(right); }
};

template <typename L>
struct Left {
  const L& left;
  explicit operator bool() const { return static_cast<bool>(left); }
  std::string values() const { return {}; }

#define NINEFOLD_COMPARE(op, compareIntegers)                                    \
  template <typename R>                                                          \
  Comparison<L, R> operator op(const R& right) const {                           \
    if constexpr (Integer<L> && Integer<R>) {                                    \
      return {std::compareIntegers(left, right), left, right};                   \
    } else if constexpr (std::is_arithmetic_v<L> && std::is_arithmetic_v<R>) {   \
      using Both = std::common_type_t<L, R>;                                     \
      return {static_cast<Both>(left) op static_cast<Both>(right), left, right}; \
    } else {                                                                     \
      return {static_cast<bool>(left op right), left, right};                    \
    }                                                                            \
  }
  NINEFOLD_COMPARE(==, cmp_equal)
  NINEFOLD_COMPARE(!=, cmp_not_equal)
  NINEFOLD_COMPARE(<, cmp_less)
  NINEFOLD_COMPARE(<=, cmp_less_equal)
  NINEFOLD_COMPARE(>, cmp_greater)
  NINEFOLD_COMPARE(>=, cmp_greater_equal)
#undef NINEFOLD_COMPARE
};

struct Values {
  template <typename L>
  Left<L> operator<=>(const L& left) const {
    return {left};
  }
};

template <typename Outcome>
void require(const Outcome& outcome, const char* expression, const char* file, int line) {
  if (static_cast<bool>(outcome)) return;
  if constexpr (std::same_as<Outcome, bool>)
    checkFailed(expression, {}, file, line);
  else
    checkFailed(expression, outcome.values(), file, line);
}

}  // namespace check

#define NINEFOLD_CHECK(expression)                                                              \
  ::ninefold::check::require(::ninefold::check::Values() <=> expression, #expression, __FILE__, \
                             __LINE__)

}  // namespace ninefold
