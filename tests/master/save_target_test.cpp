// Which file a saved scene goes to, on a disk that has the scene and one more file.
#include "master/interaction/save_target.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

class SaveTargetTest : public testing::Test {
 protected:
  SaveTargetTest() {
    for (const std::string& name : {scene, path("other.glb")}) std::ofstream(name) << "bytes";
  }
  std::string path(const char* name) const { return (folder.path() / name).string(); }

  TempFolder folder;
  std::string scene = path("room.gltf");
  SaveTarget target{scene};
};

TEST_F(SaveTargetTest, SuggestsANameBesideTheSceneThatNoFileHas) {
  EXPECT_EQ(target.suggestion(), path("room-edited.glb"));
  std::ofstream(path("room-edited.glb")) << "an earlier session's";
  EXPECT_EQ(target.suggestion(), path("room-edited-2.glb"));
}

TEST_F(SaveTargetTest, KeepsTheNameThatWasChosen) {
  EXPECT_EQ(target.file(), std::nullopt);
  EXPECT_EQ(target.choose(path("new.glb")), std::nullopt);
  EXPECT_EQ(target.file(), path("new.glb"));
  target.forget();
  EXPECT_EQ(target.file(), std::nullopt);
}

TEST_F(SaveTargetTest, AsksBeforeItWritesOverAFile) {
  EXPECT_NE(target.choose(path("other.glb")), std::nullopt);
  EXPECT_EQ(target.file(), std::nullopt);
  EXPECT_EQ(target.choose(path("other.glb")), std::nullopt);
  EXPECT_EQ(target.file(), path("other.glb"));
}

TEST_F(SaveTargetTest, AsksAgainForAnotherName) {
  std::ofstream(path("third.glb")) << "bytes";
  EXPECT_TRUE(target.choose(path("other.glb")));
  EXPECT_TRUE(target.choose(path("third.glb")));
  EXPECT_TRUE(target.choose(path("other.glb"))) << "the question was about the third";
}

// Under any of its names.
TEST_F(SaveTargetTest, KnowsTheSceneThatWasRead) {
  const std::string glb = path("read.glb");
  std::ofstream(glb) << "bytes";
  std::filesystem::create_symlink(glb, path("link.glb"));
  SaveTarget own(glb);
  for (const std::string& name : {glb, path("./read.glb"), path("link.glb")}) {
    const auto question = own.choose(name);
    ASSERT_TRUE(question) << name;
    EXPECT_NE(question->find("the scene that was read"), std::string::npos) << *question;
  }
}

TEST_F(SaveTargetTest, RefusesWhatIsNoBinaryGltf) {
  for (const char* name : {"", ".glb", "room.gltf", "room", "a.glb/"})
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(target.choose(name)) << name;
}

}  // namespace
}  // namespace ninefold
