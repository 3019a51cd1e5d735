// Of two runs that keep one file the second is told so; nothing is left of the lock.
#include "common/base/file_lock.h"

#include <gtest/gtest.h>

#include <optional>

#include "common/base/error.h"
#include "common/base/written_file.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

namespace fs = std::filesystem;

class FileLocks : public testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  // The line; empty if the file was free.
  std::string complaint(const std::string& name) const {
    try {
      const FileLock lock(path(name));
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }
  TempFolder folder_;
};

TEST_F(FileLocks, TheSecondIsRefusedUntilTheFirstIsDone) {
  std::optional<FileLock> first(path("a"));
  EXPECT_NE(complaint("a").find("is in use by another run"), std::string::npos) << complaint("a");
  EXPECT_EQ(complaint("b"), "");
  first.reset();
  EXPECT_EQ(complaint("a"), "");
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(FileLocks, HoldsWhileTheFileIsReplaced) {
  const FileLock lock(path("a"));
  for (int i = 0; i < 2; ++i) {
    writeFile(path("a"), "x");
    EXPECT_NE(complaint("a"), "");
  }
}

TEST_F(FileLocks, ALinkIsTheFileThatItLeadsTo) {
  writeFile(path("a"), "x");
  fs::create_symlink("a", path("link"));
  const FileLock lock(path("link"));
  EXPECT_NE(complaint("a"), "");
}

TEST_F(FileLocks, ALinkToNothingYetIsTheFileThatWillBeThere) {
  fs::create_directory(path("far"));
  fs::create_symlink("far/a", path("link"));
  {
    const FileLock lock(path("link"));
    EXPECT_NE(complaint("far/a"), "");
    writeFile(path("link"), "x");
    EXPECT_NE(complaint("link"), "");
    EXPECT_NE(complaint("far/a"), "");
  }
  EXPECT_EQ(complaint("far/a"), "");
  EXPECT_EQ(std::distance(fs::directory_iterator(path("far")), {}), 1);
}

TEST_F(FileLocks, WhatAKilledProgramLeftIsTakenOver) {
  writeFile(path(".ninefold.a.lock"), "");
  EXPECT_EQ(complaint("a"), "");
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(FileLocks, NoFolderIsToldInOneLine) {
  EXPECT_NE(complaint("none/a").find("cannot lock"), std::string::npos) << complaint("none/a");
}

}  // namespace
}  // namespace ninefold
