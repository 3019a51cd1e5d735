// What comes in pieces is read whole.
#include "common/base/read_up_to.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <string>
#include <thread>

#include "common/base/process.h"

namespace ninefold {
namespace {

TEST(ReadUpTo, GoesOnUntilThereIsEnoughOrNoMore) {
  Pipe pipe = makePipe();
  std::thread writer([&] {
    for (const char* piece : {"abc", "de", "fgh"})
      EXPECT_EQ(::write(pipe.writeEnd.get(), piece, std::strlen(piece)),
                ssize_t(std::strlen(piece)));
    pipe.writeEnd.reset();
  });
  std::array<char, 5> first{};
  EXPECT_EQ(readUpTo(pipe.readEnd.get(), std::as_writable_bytes(std::span(first))), 5u);
  EXPECT_EQ(std::string(first.data(), 5), "abcde");
  std::array<char, 9> rest{};
  EXPECT_EQ(readUpTo(pipe.readEnd.get(), std::as_writable_bytes(std::span(rest))), 3u);
  EXPECT_EQ(std::string(rest.data()), "fgh");
  writer.join();
}

TEST(ReadUpTo, OfNothingIsNothing) {
  std::array<std::byte, 4> bytes{};
  EXPECT_EQ(readUpTo(-1, bytes), 0u);
}

}  // namespace
}  // namespace ninefold
