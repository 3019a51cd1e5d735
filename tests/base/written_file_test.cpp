// A file is whole or as it was before; whatever stands in the way is told in one line.
#include "common/base/written_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <functional>

#include "common/base/error.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

mode_t modeOf(const fs::path& file) {
  struct stat facts {};
  EXPECT_EQ(::stat(file.c_str(), &facts), 0);
  return facts.st_mode & 07777;
}

class WrittenFiles : public testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  size_t entries() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder_.path()), {}));
  }
  fs::path beside() const {
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      if (entry.path().extension() == ".part") return entry.path();
    return {};
  }
  TempFolder folder_;
};

// The line; empty if all went well.
std::string complaint(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    return line;
  }
  return "";
}

TEST_F(WrittenFiles, ANewFileHasAllBytesAndTheModeThatTheMaskLeaves) {
  const mode_t before = ::umask(027);
  writeFile(path("a"), "0123456789");
  ::umask(before);
  EXPECT_EQ(contentOf(path("a")), "0123456789");
  EXPECT_EQ(modeOf(path("a")), 0640u);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(WrittenFiles, BytesMayComeInAnyOrder) {
  WrittenFile file(path("a"));
  file.write("head....");
  file.writeAt(12, "tail");
  file.writeAt(4, "and then");
  EXPECT_EQ(file.size(), 16u);
  file.publish();
  EXPECT_EQ(contentOf(path("a")), "headand thentail");
}

TEST_F(WrittenFiles, NothingIsToBeSeenBeforeTheEndAndNothingStaysOfWhatHadNone) {
  folder_.write("a", "old");
  {
    WrittenFile file(path("a"));
    file.write("new");
    EXPECT_EQ(contentOf(path("a")), "old");
  }
  EXPECT_EQ(contentOf(path("a")), "old");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(WrittenFiles, AReplacedFileHandsItsModeAndOwnerOn) {
  folder_.write("a", "old");
  fs::permissions(path("a"), fs::perms(0604));
  const bool isRoot = ::geteuid() == 0;
  if (isRoot) {
    ASSERT_EQ(::chown(path("a").c_str(), 4711, 4712), 0);
  }
  writeFile(path("a"), "new", {.mode = 0600});
  EXPECT_EQ(modeOf(path("a")), 0604u);
  struct stat facts {};
  ASSERT_EQ(::stat(path("a").c_str(), &facts), 0);
  EXPECT_EQ(facts.st_uid, isRoot ? 4711u : ::geteuid());
  EXPECT_EQ(contentOf(path("a")), "new");
}

TEST_F(WrittenFiles, LinksAreFollowedAndStay) {
  folder_.write("far/away/file", "old");
  fs::create_symlink("../away/file", path("far/b"));
  fs::create_directory(path("far/here"));
  fs::create_symlink(fs::absolute(path("far/away/file")), path("absolute"));
  fs::create_symlink("far/away/file", path("relative"));
  fs::create_symlink("relative", path("chain"));
  fs::create_symlink("far", path("folder"));
  fs::create_symlink("away/none yet", path("far/dangling"));
  for (const char* name : {"absolute", "relative", "chain"}) {
    writeFile(path(name), name);
    EXPECT_EQ(contentOf(path("far/away/file")), name);
    EXPECT_TRUE(fs::is_symlink(path(name))) << name;
  }
  writeFile(path("folder/away/file"), "through a folder's link");
  EXPECT_EQ(contentOf(path("far/away/file")), "through a folder's link");
  writeFile(path("far/dangling"), "there");
  EXPECT_EQ(contentOf(path("far/away/none yet")), "there");
  EXPECT_TRUE(fs::is_symlink(path("far/dangling")));
}

TEST_F(WrittenFiles, WhatIsNoFileOrHasNoFolderIsRefusedBeforeTheWorkAndAtTheWork) {
  fs::create_directory(path("folder"));
  folder_.write("file", "text");
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/null", path("link to a device"));
  fs::create_symlink("circle", path("circle"));
  const std::pair<fs::path, const char*> cases[] = {
      {"/dev/null", "a device"},
      {path("link to a device"), "a device"},
      {path("pipe"), "a pipe"},
      {path("folder"), "a folder"},
      {path("folder/"), "no file"},
      {"", "no file"},
      {path("none/a"), "there is no folder"},
      {path("file/a"), "no folder"},
      {path("circle"), "symbolic links"},
      {path(std::string(256, 'n')), "name too long"},
      {"/proc/a", "no file can be created in /proc"},
  };
  for (const auto& [name, reason] : cases)
    for (const std::string& line :
         {complaint([&] { checkWritable(name); }), complaint([&] { writeFile(name, "text"); })}) {
      EXPECT_NE(line.find("cannot write " + name.string()), std::string::npos) << line;
      EXPECT_NE(line.find(reason), std::string::npos) << line;
    }
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(entries(), 5u);
}

TEST_F(WrittenFiles, TheLongestNameIsNoneTooMany) {
  const fs::path name = path(std::string(255, 'n'));
  checkWritable(name);
  writeFile(name, "text");
  EXPECT_EQ(contentOf(name), "text");
}

TEST_F(WrittenFiles, AWriteProtectedFileIsRefused) {
  folder_.write("a", "old");
  fs::permissions(path("a"), fs::perms(0444));
  fs::permissions(folder_.path(), fs::perms(0777));
  // Root may write everything, so that it must be somebody else here.
  const uid_t user = ::geteuid();
  if (user == 0) {
    ASSERT_EQ(::seteuid(65534), 0);
  }
  const std::string line = complaint([&] { checkWritable(path("a")); });
  if (user == 0) {
    ASSERT_EQ(::seteuid(0), 0);
  }
  EXPECT_NE(line.find("write-protected"), std::string::npos) << line;
}

TEST_F(WrittenFiles, ABytesLimitLeavesTheOldFile) {
  folder_.write("a", "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = ::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string line = complaint([&] { writeFile(path("a"), std::string(4097, 'x')); });
  const std::string fits = complaint([&] { writeFile(path("b"), std::string(4096, 'x')); });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  ::signal(SIGXFSZ, handler);
  EXPECT_NE(line.find("a: File too large"), std::string::npos) << line;
  EXPECT_EQ(fits, "");
  EXPECT_EQ(contentOf(path("a")), "old");
  EXPECT_EQ(entries(), 2u);
}

TEST_F(WrittenFiles, AfterAFailedWriteNothingIsPublished) {
  folder_.write("a", "old");
  WrittenFile file(path("a"));
  file.write("whole");
  EXPECT_NE(complaint([&] { file.writeAt(uint64_t{1} << 63, "too far"); }), "");
  EXPECT_NE(complaint([&] { file.publish(); }), "");
  EXPECT_EQ(contentOf(path("a")), "old");
}

TEST_F(WrittenFiles, BytesThatDidNotArriveAreNoticed) {
  folder_.write("a", "old");
  const std::string line = complaint([&] {
    WrittenFile file(path("a"));
    file.write("0123456789");
    fs::resize_file(beside(), 7);
    file.publish();
  });
  EXPECT_NE(line.find("only 7 of 10 bytes"), std::string::npos) << line;
  EXPECT_EQ(contentOf(path("a")), "old");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(WrittenFiles, OfTwoWritersAtOnceTheLastOneWinsWhole) {
  WrittenFile first(path("a")), second(path("a"));
  first.write("first");
  second.write("the second");
  second.publish();
  EXPECT_EQ(contentOf(path("a")), "the second");
  first.publish();
  EXPECT_EQ(contentOf(path("a")), "first");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(WrittenFiles, WhatAKilledWriterLeftGoesAndWhatALivingOneWritesStays) {
  folder_.write(".ninefold.999999999.0.part", "half a pict");
  folder_.write(".ninefold.mine", "no writer's");
  WrittenFile living(path("b"));
  living.write("living");
  checkWritable(path("a"));
  EXPECT_FALSE(fs::exists(path(".ninefold.999999999.0.part")));
  EXPECT_TRUE(fs::exists(path(".ninefold.mine")));
  living.publish();
  EXPECT_EQ(contentOf(path("b")), "living");
}

TEST_F(WrittenFiles, WhatAKilledWriterLeftGoesFromWhereALinkLeads) {
  fs::create_directory(path("far"));
  folder_.write("far/.ninefold.999999999.0.part", "half a pict");
  fs::create_symlink("far/a", path("link"));
  checkWritable(path("link"));
  EXPECT_FALSE(fs::exists(path("far/.ninefold.999999999.0.part")));
}

TEST_F(WrittenFiles, WhatAKilledProcessOfOurNumberLeftIsNotInTheWay) {
  for (int i = 0; i < 200; ++i)
    folder_.write(".ninefold." + std::to_string(::getpid()) + "." + std::to_string(i) + ".part",
                  "");
  writeFile(path("a"), "text");
  EXPECT_EQ(contentOf(path("a")), "text");
}

TEST_F(WrittenFiles, WhatMayNotBeReplacedIsNot) {
  const FileRights rights{.mode = 0600, .mayReplace = false};
  folder_.write("a", "old");
  fs::create_symlink("elsewhere", path("link"));
  for (const char* name : {"a", "link"})
    EXPECT_NE(complaint([&] { writeFile(path(name), "new", rights); }).find("exists already"),
              std::string::npos);
  EXPECT_EQ(contentOf(path("a")), "old");
  EXPECT_FALSE(fs::exists(path("elsewhere")));

  WrittenFile late(path("b"), rights);
  folder_.write("b", "quicker");
  EXPECT_NE(complaint([&] { late.publish(); }), "");
  EXPECT_EQ(contentOf(path("b")), "quicker");
  writeFile(path("c"), "new", rights);
  EXPECT_EQ(contentOf(path("c")), "new");
  EXPECT_EQ(modeOf(path("c")), 0600u);
}

TEST_F(WrittenFiles, AnotherProgramMayWriteWhatIsPublished) {
  folder_.write("a", "old");
  WrittenFile file(path("a"));
  std::ofstream(file.beside()) << "by another";
  EXPECT_EQ(contentOf(path("a")), "old");
  file.takeWhatIsThere();
  file.publish();
  EXPECT_EQ(contentOf(path("a")), "by another");
  EXPECT_EQ(entries(), 1u);
}

}  // namespace
}  // namespace ninefold
