// The table of keys: each line is reached, and docs/window.md shows the same.
#include "master/interaction/window_keys.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace ninefold {
namespace {

TEST(WindowKeys, EveryLineIsWhatItsKeyMeans) {
  for (const WindowKey& row : windowKeys()) {
    if (row.use == WindowKey::Use::told || row.use == WindowKey::Use::view) continue;
    Modifiers held;
    held.control = row.control, held.shift = row.shift;
    EXPECT_EQ(meaningOf(row.key, held), &row) << row.keys;
  }
}

TEST(WindowKeys, WithControlAKeyIsAnother) {
  EXPECT_EQ(meaningOf('S', {.control = true})->command, Command::Kind::saveScene);
  EXPECT_EQ(meaningOf('S', {})->use, WindowKey::Use::fly);
  EXPECT_EQ(meaningOf('F', {.control = true}), nullptr);
  EXPECT_EQ(meaningOf('J', {}), nullptr);
  EXPECT_EQ(meaningOf(0, {}), nullptr) << "what is told only has no key";
}

TEST(WindowKeys, TheDocumentShowsTheTable) {
  std::ifstream in(NINEFOLD_SCENES "/../docs/window.md");
  std::ostringstream text;
  text << in.rdbuf();
  std::string table = "| key | does |\n|---|---|\n";
  for (const WindowKey& row : windowKeys())
    table += std::string("| ") + row.keys + " | " + row.does + " |\n";
  EXPECT_NE(text.str().find(table + "\n"), std::string::npos) << "it should have\n" << table;
}

}  // namespace
}  // namespace ninefold
