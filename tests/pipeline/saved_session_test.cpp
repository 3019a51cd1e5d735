// A session of random edits, with undo and redo, saved and read again: the same values, and the
// same picture as far as its noise lets see.
//
// The saved file's bounds are those of what is in it, while a session's only grow. So b, r and the
// origin of the coordinates differ, and bytes cannot be the same. Both pictures have seeds of their
// own; with block means a, b and their standard errors e_a, e_b,  |a - b| < 3 sqrt(e_a^2 + e_b^2).
#include <gtest/gtest.h>

#include "common/image/film.h"
#include "common/scene/gltf_writer.h"
#include "common/scene/reader.h"
#include "master/interaction/edit_history.h"
#include "tests/pipeline/one_process.h"
#include "tests/scene/random_edits.h"
#include "tests/scene/same_scene.h"
#include "tests/scene/table_room.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

constexpr int kEdits = 1000, kFrames = 32;
constexpr int kWidth = 48, kHeight = 32;

Scene afterASession(const std::shared_ptr<const Scene>& scene) {
  RandomEdits random(*scene, 23);
  std::mt19937 dice(5);
  EditHistory history(scene);
  for (uint64_t i = 0; i < kEdits; ++i) {
    const auto what = dice() % 10;
    if (what == 0)
      history.undo();
    else if (what == 1)
      history.redo();
    else
      history.apply(random.next(), i / 2);
  }
  return edited(*scene, history.all());
}

// Mean luminance of a block of pixels, or of all: of each frame.
struct Means {
  std::vector<double> sum, sumOfSquares;

  void add(size_t i, double value) {
    if (i >= sum.size()) sum.resize(i + 1), sumOfSquares.resize(i + 1);
    sum[i] += value, sumOfSquares[i] += value * value;
  }
  double mean(size_t i) const { return sum[i] / kFrames; }
  double squaredError(size_t i) const {
    return (sumOfSquares[i] / kFrames - mean(i) * mean(i)) / (kFrames - 1);
  }
};

Means blocksOf(const Scene& scene, uint64_t seed) {
  const Tracer tracer(scene, Isa::automatic);
  Settings settings;
  settings.width = kWidth, settings.height = kHeight, settings.seed = seed;
  testing::OneProcess process(tracer, settings);
  Means means;
  for (int frame = 0; frame < kFrames; ++frame) {
    const RgbImage& image = process.nextFrame();
    std::vector<double> blocks(size_t{kWidth / kErrorBlock} * (kHeight / kErrorBlock) + 1, 0);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const auto L = static_cast<double>(luminance(image.rgb(image.at(x, y))));
        blocks[static_cast<size_t>(y / kErrorBlock * (kWidth / kErrorBlock) + x / kErrorBlock)] +=
            L / (kErrorBlock * kErrorBlock);
        blocks.back() += L / (kWidth * kHeight);
      }
    for (size_t i = 0; i < blocks.size(); ++i) means.add(i, blocks[i]);
  }
  return means;
}

TEST(SavedSession, HasTheSameValuesAndTheSamePicture) {
  const auto read = std::make_shared<const Scene>(tableRoomWithSpot());
  const Scene session = afterASession(read);
  const TempFolder folder;
  const std::string path = folder.write("saved.glb", "");
  writeGltf(path, session);
  const Scene saved = readScene(path);
  expectSameScene(session, saved);

  const Means a = blocksOf(session, 1), b = blocksOf(saved, 2), before = blocksOf(*read, 3);
  int otherThanBefore = 0;
  for (size_t i = 0; i < a.sum.size(); ++i) {
    const double error = std::sqrt(a.squaredError(i) + b.squaredError(i));
    EXPECT_LT(std::abs(a.mean(i) - b.mean(i)), 3 * error)
        << "block " << i << ": " << a.mean(i) << " and " << b.mean(i) << ", +- " << error;
    otherThanBefore += std::abs(before.mean(i) - b.mean(i)) > 6 * error;
  }
  EXPECT_GT(otherThanBefore, 3) << "a picture that saw no edit would pass, too";
}

}  // namespace
}  // namespace ninefold
