#include "proto/key.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

namespace ninefold {
namespace {

namespace fs = std::filesystem;

class KeyFile : public testing::Test {
 protected:
  KeyFile() {
    std::string name = (fs::temp_directory_path() / "ninefold-key-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~KeyFile() override { fs::remove_all(folder_); }

  fs::path write(const char* name, size_t bytes, mode_t mode) {
    const fs::path file = folder_ / name;
    std::ofstream(file) << std::string(bytes, 'k');
    ::chmod(file.c_str(), mode);
    return file;
  }
  static std::string refusal(const fs::path& file) {
    try {
      Key::load(file);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  fs::path folder_;
};

std::string contentOf(const Key& key) {
  return std::string(reinterpret_cast<const char*>(key.bytes().data()), Key::kBytes);
}

TEST_F(KeyFile, ANewKeyIsRandomPrivateAndLoads) {
  createKeyFile(folder_ / "a"), createKeyFile(folder_ / "b");
  struct stat facts {};
  ASSERT_EQ(::stat((folder_ / "a").c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 07777, 0600u);
  EXPECT_EQ(facts.st_size, 32);
  EXPECT_EQ(contentOf(Key::load(folder_ / "a")), contentOf(Key::load(folder_ / "a")));
  EXPECT_NE(contentOf(Key::load(folder_ / "a")), contentOf(Key::load(folder_ / "b")));
}

TEST_F(KeyFile, NothingIsOverwritten) {
  const fs::path file = write("precious", 5, 0600);
  EXPECT_THROW(createKeyFile(file), Error);
  EXPECT_EQ(fs::file_size(file), 5u);
  EXPECT_THROW(createKeyFile(folder_ / "no" / "folder"), Error);
}

TEST_F(KeyFile, LooserModesAreRefusedWithTheRemedy) {
  for (const mode_t mode : {0640u, 0604u, 0620u, 0660u, 0610u, 0644u})
    EXPECT_NE(refusal(write("key", 32, mode)).find("chmod 600"), std::string::npos) << mode;
  EXPECT_EQ(refusal(write("key", 32, 0600)), "");
  EXPECT_EQ(refusal(write("key", 32, 0400)), "");
}

TEST_F(KeyFile, OtherLengthsAreRefused) {
  for (const size_t size : {0u, 31u, 33u, 64u, 100000u})
    EXPECT_NE(refusal(write("key", size, 0600)).find("instead of 32"), std::string::npos) << size;
}

TEST_F(KeyFile, OnlyRegularFilesAreKeys) {
  EXPECT_NE(refusal(folder_), "");
  EXPECT_NE(refusal(folder_ / "missing").find("ninefold-master --new-key"), std::string::npos);
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_NE(refusal(folder_ / "pipe").find("not a regular file"), std::string::npos);
  EXPECT_NE(refusal("/dev/urandom"), "");
}

TEST_F(KeyFile, OneThatIsNotOursNeedsNoNewOne) {
  if (::geteuid() == 0) GTEST_SKIP() << "root reads all files";
  const std::string line = refusal(write("key", 32, 0200));
  EXPECT_NE(line.find("Permission denied; it must belong to the user"), std::string::npos) << line;
  EXPECT_EQ(line.find("--new-key"), std::string::npos) << line;
}

TEST_F(KeyFile, ErrorsAreOneLineWithoutTheKey) {
  for (const std::string& text :
       {refusal(write("key", 33, 0600)), refusal(write("key", 32, 0644))}) {
    EXPECT_EQ(text.find('\n'), std::string::npos);
    EXPECT_EQ(text.find("kkk"), std::string::npos);
  }
}

TEST(Key, TravelsThroughAPipe) {
  const Key key = Key::random();
  const int end = keyPipe(key);
  EXPECT_TRUE((::fcntl(end, F_GETFD) & FD_CLOEXEC) != 0);
  EXPECT_EQ(contentOf(Key::receive(end)), contentOf(key));
  EXPECT_EQ(::fcntl(end, F_GETFD), -1) << "the descriptor is closed";
}

TEST(Key, AHalfKeyOrNoneIsRefused) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ASSERT_EQ(::write(ends[1], "half", 4), 4);
  ::close(ends[1]);
  EXPECT_THROW(Key::receive(ends[0]), Error);
  EXPECT_THROW(Key::receive(-1), Error);
}

TEST(Key, IsWipedWhenItDies) {
  alignas(Key) std::byte place[sizeof(Key)];
  Key* key = new (place) Key(Key::random());
  Key moved = std::move(*key);
  EXPECT_EQ(contentOf(*key), std::string(Key::kBytes, '\0')) << "moved from";
  Key* other = new (place) Key(std::move(moved));
  EXPECT_NE(contentOf(*other), std::string(Key::kBytes, '\0'));
  other->~Key();
  for (const std::byte b : place) EXPECT_EQ(b, std::byte{0});
}

}  // namespace
}  // namespace ninefold
