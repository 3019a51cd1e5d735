// Who is in control.
#include "master/web/viewer_book.h"

#include <gtest/gtest.h>

namespace ninefold {
namespace {

ViewerBook bookOf(std::initializer_list<ViewerId> viewers) {
  ViewerBook book;
  for (const ViewerId id : viewers) book.join(id);
  return book;
}

TEST(ViewerBook, TheFirstWhoComesIsInControl) {
  ViewerBook book;
  EXPECT_EQ(book.inControl(), std::nullopt);
  book.join(7);
  book.join(8);
  EXPECT_TRUE(book.isInControl(7));
  EXPECT_FALSE(book.isInControl(8));
}

TEST(ViewerBook, ControlGoesToWhoHasAskedForLongest) {
  ViewerBook book = bookOf({1, 2, 3});
  book.ask(3);
  book.ask(2);
  book.ask(3);  // asking twice does not move one
  EXPECT_EQ(book.asking(), (std::vector<ViewerId>{3, 2}));
  book.give(2);  // not in control
  EXPECT_TRUE(book.isInControl(1));
  book.give(1);
  EXPECT_TRUE(book.isInControl(3));
  EXPECT_EQ(book.asking(), std::vector<ViewerId>{2});
}

TEST(ViewerBook, ControlStaysIfNobodyAsks) {
  ViewerBook book = bookOf({1, 2});
  book.ask(1);  // who has it already
  book.give(1);
  EXPECT_TRUE(book.isInControl(1));
}

TEST(ViewerBook, WhoLeavesLeavesControlToWhoAskedElseToWhoCameNext) {
  ViewerBook book = bookOf({1, 2, 3, 4});
  book.ask(4);
  book.ask(3);
  book.leave(4);
  book.leave(1);
  EXPECT_TRUE(book.isInControl(3));
  book.leave(3);
  EXPECT_TRUE(book.isInControl(2));
  book.leave(2);
  EXPECT_EQ(book.inControl(), std::nullopt);
  book.join(5);
  EXPECT_TRUE(book.isInControl(5));
}

}  // namespace
}  // namespace ninefold
