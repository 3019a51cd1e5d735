// What a session shows of frames that come in tile by tile. Expected pictures are made the long
// way: the same frames filtered into a film of their own, its mean tone mapped as a whole.
#include "master/running/live_picture.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <span>

#include "common/image/tone_map.h"
#include "common/sampling/whole_tile.h"
#include "master/assembly/picture.h"

namespace ninefold {
namespace {

constexpr SurfaceTest kTest = SurfaceTest::surface;
// A level of its code, so that it comes back as it is.
const float kReflectance = SquareCode::level(200, kInvPi);

// Light of all sizes on a wall, another for each frame.
GatheredFrame frameOf(uint32_t number, int width, int height) {
  const TileGrid grid(width, height, {3, 2});
  GatheredFrame frame;
  frame.view.key.frame = number;
  frame.view.shape = {grid, kDiffuseBit, 0};
  frame.view.camera = {"", Vec3(0), Vec3(0, 0, -1), Vec3(0, 1, 0), 0.8f};
  frame.tasks.resize(static_cast<size_t>(grid.tasks()));
  std::mt19937 random(number);
  std::lognormal_distribution<float> light(0, 2);
  for (int tile = 0; tile < grid.tiles(); ++tile)
    for (int phase = 0; phase < grid.interleave().sets(); ++phase) {
      const TaskRect rect = grid.rect(tile, phase);
      TileResult task;
      task.reset(rect.width, rect.height, kDiffuseBit, 0);
      LayerPlanes& layer = task.layers[kDiffuse];
      for (size_t i = 0; i < layer.distance.size(); ++i) {
        layer.distance[i] = 3, layer.normal.b[i] = 1;
        layer.reflectance.r[i] = layer.reflectance.g[i] = layer.reflectance.b[i] = kReflectance;
        layer.irradiance.r[i] = light(random), layer.irradiance.b[i] = light(random);
      }
      frame.tasks[static_cast<size_t>(tile * grid.interleave().sets() + phase)] =
          TileDecoder().unpack(TileEncoder().encode(task, random(), 0).bytes,
                               {rect.width, rect.height, kDiffuseBit, 0});
    }
  return frame;
}

// The same picture as clients would send it: a finished tile in each task of phase 0.
GatheredFrame finished(uint32_t number, const RgbImage& picture, const ToneMap* codes) {
  const TileGrid grid(picture.width, picture.height, {3, 2});
  const uint8_t mask = codes != nullptr ? kDisplayMask : kRadianceMask;
  GatheredFrame frame;
  frame.view.key.frame = number;
  frame.view.shape = {grid, mask, 0};
  frame.tasks.resize(static_cast<size_t>(grid.tasks()));
  for (int tile = 0; tile < grid.tiles(); ++tile) {
    const TaskRect rect = pixelsOf(grid, tile);
    RgbImage part;
    part.reset(rect.width, rect.height);
    for (int y = 0; y < rect.height; ++y)
      for (int x = 0; x < rect.width; ++x) {
        const Vec3 value = picture.rgb(picture.at(rect.i0 + x, rect.j0 + y));
        const size_t i = part.at(x, y);
        part.pixels.r[i] = value.x, part.pixels.g[i] = value.y, part.pixels.b[i] = value.z;
      }
    TileEncoder encoder;
    Bytes bytes = codes != nullptr ? encoder.encode(part, *codes, 1).bytes
                                   : encoder.encode(part, number, 1).bytes;
    frame.tasks[static_cast<size_t>(tile * grid.interleave().sets())] =
        TileDecoder().unpack(std::move(bytes), {rect.width, rect.height, mask, 0});
  }
  return frame;
}

class LivePictureTest : public testing::Test {
 protected:
  // Tiles last first, as two workers might do them.
  static std::shared_ptr<const LiveImage> shown(const GatheredFrame& frame, const LiveFrame& plan,
                                                const LiveLook& look, LivePicture& by) {
    const TileGrid& grid = frame.view.shape.grid;
    const std::vector<uint32_t> owners(frame.tasks.size());
    for (int tile = grid.tiles() - 1; tile >= 0; --tile)
      by.finishTile(tile % 2, frame, plan, look, owners, tile);
    by.frameDone();
    return by.image();
  }
  std::shared_ptr<const LiveImage> shown(const GatheredFrame& frame, const LiveFrame& plan,
                                         const LiveLook& look) {
    return shown(frame, plan, look, picture);
  }
  std::shared_ptr<const LiveImage> inMotion(const GatheredFrame& frame, const LiveLook& look) {
    LiveFrame plan;
    plan.moving = true, plan.world = frame.view.key.frame;  // somebody edits
    return shown(frame, plan, look);
  }
  static std::shared_ptr<const LiveImage> atRest(const GatheredFrame& frame, int64_t rested,
                                                 const LiveLook& look, LivePicture& by,
                                                 bool isLast = false) {
    LiveFrame plan;
    plan.rested = rested, plan.last = isLast;
    return shown(frame, plan, look, by);
  }
  std::shared_ptr<const LiveImage> atRest(const GatheredFrame& frame, int64_t rested,
                                          const LiveLook& look) {
    return atRest(frame, rested, look, picture);
  }
  static void addGuides(const GatheredFrame& frame, GuideFilm& guides) {
    Patch patch;
    for (int t = 0; t < frame.view.shape.grid.tiles(); ++t) {
      gather(frame, t, patch);
      guides.addPatch(patch);
    }
    guides.frameDone();
  }

  // The same as PictureMaker and a file would make of the frames.
  static RgbImage expectedMean(std::span<const GatheredFrame> frames) {
    const TileGrid& grid = frames[0].view.shape.grid;
    Film film(grid.width(), grid.height());
    Patch patch;
    PatchFilter filter(kTest);
    RgbImage tile, mean;
    for (const GatheredFrame& frame : frames) {
      for (int t = 0; t < grid.tiles(); ++t) {
        gather(frame, t, patch);
        filter.compose(patch, frame.view.camera, frame.view.neighbourWeight, tile);
        film.addTile(patch.x0(), patch.y0(), tile);
      }
      film.frameDone();
    }
    film.mean(mean);
    return mean;
  }
  static DisplayImage codesOf(const RgbImage& image, float exposure) {
    DisplayImage codes;
    ToneMap(exposure).apply(image, codes);
    return codes;
  }

  LivePicture picture{{kTest, 2, 1, true}};
};

constexpr PictureView kBeauty = PictureView::beauty;

TEST_F(LivePictureTest, InMotionShowsTheFrameAndItsCodes) {
  for (const auto& [number, width] : {std::pair{0u, 200}, {1u, 100}, {2u, 200}}) {
    const GatheredFrame frame = frameOf(number, width, 130);
    const auto image = inMotion(frame, {kBeauty, -2.0f});
    EXPECT_TRUE(image->radiance == expectedMean({&frame, 1}));
    EXPECT_TRUE(image->display == codesOf(image->radiance, -2));
    EXPECT_EQ(image->tone.exposure, -2);
  }
}

// Only the camera might have moved: the mean of both frames, to rounding.
TEST_F(LivePictureTest, InMotionOfTheCameraUsesLightAgain) {
  std::vector<GatheredFrame> frames;
  for (const uint32_t number : {0u, 1u}) frames.push_back(frameOf(number, 200, 130));
  LiveFrame plan;
  plan.moving = true;
  shown(frames[0], plan, {kBeauty, 0.0f});
  const RgbImage found = shown(frames[1], plan, {kBeauty, 0.0f})->radiance;
  const RgbImage mean = expectedMean(frames);
  for (size_t i = 0; i < mean.count(); ++i)
    ASSERT_NEAR(found.pixels.r[i], mean.pixels.r[i], 1e-5f * (1 + mean.pixels.r[i]));
}

TEST_F(LivePictureTest, AtRestShowsTheMeanAndItsCodes) {
  std::vector<GatheredFrame> frames;
  for (uint32_t i = 0; i < 4; ++i) {
    frames.push_back(frameOf(i, 200, 130));
    const float exposure = 0.5f * static_cast<float>(i);  // changes while the picture rests
    const auto image = atRest(frames.back(), i, {kBeauty, exposure});
    EXPECT_TRUE(image->radiance == expectedMean(frames));
    EXPECT_TRUE(image->display == codesOf(image->radiance, exposure));
  }
  EXPECT_EQ(picture.frames(), 4);
  const GatheredFrame next = frameOf(9, 200, 130);
  EXPECT_TRUE(atRest(next, 0, {kBeauty, 0.0f})->radiance == expectedMean({&next, 1}));
}

// The film's mean stays as it is; its codes are touched after 4 and 9 frames and stay meanwhile.
TEST_F(LivePictureTest, CodesOfLightAtRestGetTheLastTouch) {
  LivePicture touching{{kTest, 2, 1, true}};
  Film film(200, 130);
  GuideFilm guides(200, 130);
  std::vector<GatheredFrame> frames;
  DisplayImage before;
  for (uint32_t i = 0; i < 9; ++i) {
    frames.push_back(frameOf(i, 200, 130));
    film.add(expectedMean({&frames.back(), 1}));
    addGuides(frames.back(), guides);
    const auto image = atRest(frames.back(), i, {kBeauty, 0.0f, {}, true}, touching);
    RgbImage expected = image->radiance;
    EXPECT_TRUE(expected == expectedMean(frames));
    if (i > 2) denoise(expected, film.standardError(), guides.guides(), 1);
    const bool isHeld = i > 3 && i < 8;
    EXPECT_TRUE(image->display == (isHeld ? before : codesOf(expected, 0))) << i;
    EXPECT_EQ(image->display == codesOf(image->radiance, 0), i < 3) << i;
    before = image->display;
  }
  // Another exposure is another code for the same picture.
  EXPECT_FALSE(atRest(frameOf(9, 200, 130), 9, {kBeauty, 1.0f, {}, true}, touching)->display ==
               before);
  const auto sets =
      atRest(frameOf(10, 200, 130), 10, {PictureView::sets, 0.0f, {}, true}, touching);
  EXPECT_TRUE(sets->display == codesOf(sets->radiance, 0));
}

TEST_F(LivePictureTest, FinishedTilesOfClientsAreNotTouched) {
  LivePicture touching{{kTest, 2, 1, true}};
  for (uint32_t i = 0; i < 3; ++i) {
    const GatheredFrame frame = frameOf(i, 200, 130);
    const GatheredFrame sent = finished(i, expectedMean({&frame, 1}), nullptr);
    const auto image = atRest(sent, i, {kBeauty, 0.0f, {}, true}, touching);
    EXPECT_TRUE(image->display == codesOf(image->radiance, 0));
  }
}

// The same as headless, which looks at the film once it is done.
TEST_F(LivePictureTest, AStillTakesOfItsNeighboursWhatTheFilmAllows) {
  constexpr int64_t kFrames = 6;
  LivePicture still{{kTest, 2, 1, false}};
  const Interleave pattern = frameOf(0, 200, 130).view.shape.grid.interleave();
  const LiveLook look{kBeauty, 0.0f, {.pattern = pattern}};
  Film film(200, 130, look.keeps);
  FilterDesk desk(kTest);
  std::shared_ptr<const LiveImage> image;
  for (uint32_t i = 0; i < kFrames; ++i) {
    const GatheredFrame frame = frameOf(i, 200, 130);
    image = atRest(frame, i, look, still, i + 1 == kFrames);
    for (int t = 0; t < frame.view.shape.grid.tiles(); ++t) {
      gather(frame, t, desk.patch);
      desk.filter.compose(desk.patch, frame.view.camera, frame.view.neighbourWeight, desk.beauty,
                          &desk.unfiltered);
      film.addTile(desk.patch.x0(), desk.patch.y0(), desk.unfiltered, &desk.beauty);
    }
    film.frameDone();
  }
  RgbImage expected;
  film.mean(expected);
  EXPECT_TRUE(image->radiance == expected);
  EXPECT_TRUE(image->display == codesOf(expected, 0));
  // A new picture knows nothing of the old one's share.
  const GatheredFrame next = frameOf(9, 200, 130);
  const RgbImage filtered = expectedMean({&next, 1});
  const auto first = atRest(next, 0, look, still);
  for (size_t i = 0; i < filtered.count(); ++i)
    ASSERT_NEAR(first->radiance.pixels.g[i], filtered.pixels.g[i],
                1e-5f * (1 + filtered.pixels.g[i]));
}

TEST_F(LivePictureTest, WithoutAnOnlookerThereAreNoCodes) {
  EXPECT_TRUE(inMotion(frameOf(0, 100, 60), {kBeauty, {}})->display.empty());
  EXPECT_FALSE(inMotion(frameOf(1, 100, 60), {kBeauty, 0.0f})->display.empty());
  EXPECT_TRUE(inMotion(frameOf(2, 100, 60), {kBeauty, {}})->display.empty());
}

TEST_F(LivePictureTest, WhatSomebodyHoldsStaysAndWhatNobodyHoldsIsUsedAgain) {
  const auto held = inMotion(frameOf(0, 100, 60), {kBeauty, 0.0f});
  const LiveImage before = *held;
  std::set<const LiveImage*> others;
  for (uint32_t i = 1; i < 6; ++i) {
    const auto image = i % 2 == 0 ? inMotion(frameOf(i, 100, 60), {kBeauty, 0.0f})
                                  : atRest(frameOf(i, 100, 60), 0, {kBeauty, 0.0f});
    EXPECT_NE(image, held);
    others.insert(image.get());
  }
  EXPECT_TRUE(held->radiance == before.radiance && held->display == before.display);
  EXPECT_EQ(others.size(), 1u);
}

TEST_F(LivePictureTest, CodesOfClientsAreShownAsTheyAre) {
  const GatheredFrame frame = frameOf(0, 200, 130);
  const RgbImage radiance = expectedMean({&frame, 1});
  const ToneMap toneMap(1);
  const auto image = inMotion(finished(1, radiance, &toneMap), {kBeauty, 1.0f});
  EXPECT_TRUE(image->display == codesOf(radiance, 1));
  EXPECT_EQ(image->radiance.count(), 0u);
  EXPECT_EQ(image->width, 200);
  const auto still = atRest(finished(2, radiance, &toneMap), 0, {kBeauty, 1.0f});
  EXPECT_TRUE(still->display == image->display);
  EXPECT_EQ(picture.frames(), 1);
}

// Layers, codes and radiance in turn: a rest that begins after codes starts from its own frames.
TEST_F(LivePictureTest, RadianceOfClientsIsSummedUp) {
  const GatheredFrame frame = frameOf(0, 200, 130);
  const RgbImage sent = expectedMean({&frame, 1});
  const ToneMap toneMap(0);
  Film film(200, 130);
  for (uint32_t i = 0; i < 3; ++i) {
    if (i == 0) inMotion(finished(9, sent, &toneMap), {kBeauty, 0.0f});
    const GatheredFrame next = finished(i, sent, nullptr);
    RgbImage tile, mean;
    for (int t = 0; t < next.view.shape.grid.tiles(); ++t) {
      const TaskRect rect = pixelsOf(next.view.shape.grid, t);
      next.task(t, 0).copyRadiance(tile);
      film.addTile(rect.i0, rect.j0, tile);
    }
    film.frameDone();
    film.mean(mean);
    const auto image = atRest(next, i, {kBeauty, 0.0f});
    EXPECT_TRUE(image->radiance == mean);
    EXPECT_TRUE(image->display == codesOf(mean, 0));
  }
}

// Sets are painted over frames 2 and 3; the light of all frames is there when it is looked at
// again.
TEST_F(LivePictureTest, LightIsSummedUpWhateverIsShownOfIt) {
  std::vector<GatheredFrame> frames;
  for (uint32_t i = 0; i < 5; ++i) {
    frames.push_back(frameOf(i, 200, 130));
    const bool painted = i == 2 || i == 3;
    const auto image = atRest(frames[i], i, {painted ? PictureView::sets : kBeauty, 0.0f});
    EXPECT_EQ(image->radiance == expectedMean(frames), !painted);
    EXPECT_EQ(picture.frames(), painted ? i - 1 : i + 1);
  }
  // What is painted is not mixed with what was painted before another view was chosen.
  const Vec3 color = atRest(frameOf(5, 200, 130), 5, {PictureView::sets, 0.0f})->radiance.rgb(0);
  EXPECT_EQ(color, colorOf(static_cast<uint32_t>(lightSetOfPhase(0, 0, 6))));
  EXPECT_EQ(picture.frames(), 1);
}

// A frame may be given up with half of its tiles done, for another look, and begun anew.
TEST_F(LivePictureTest, AFrameThatIsBegunAnewCountsOnce) {
  std::vector<GatheredFrame> frames;
  for (const uint32_t number : {0u, 1u}) frames.push_back(frameOf(number, 200, 130));
  atRest(frames[0], 0, {kBeauty, 0.0f});
  const std::vector<uint32_t> owners(frames[1].tasks.size());
  LiveFrame plan;
  plan.rested = 1;
  for (const int tile : {0, 3})
    picture.finishTile(0, frames[1], plan, {kBeauty, 0.0f}, owners, tile);
  GatheredFrame again = frameOf(1, 200, 130);
  again.view.key.frame = 2;
  EXPECT_TRUE(atRest(again, 1, {kBeauty, 0.0f})->radiance == expectedMean(frames));
}

// Pick planes of the first frame hold for the rest; a frame in motion without them has none.
TEST_F(LivePictureTest, WhatIsWhereHoldsForAllFramesOfARest) {
  GatheredFrame first = frameOf(0, 100, 60);
  first.view.shape.extraMask = kPickPlanes;
  const TileGrid& grid = first.view.shape.grid;
  for (int tile = 0; tile < grid.tiles(); ++tile)
    for (int phase = 0; phase < grid.interleave().sets(); ++phase) {
      const TaskRect rect = grid.rect(tile, phase);
      TileResult task;
      task.reset(rect.width, rect.height, kDiffuseBit, kPickPlanes);
      for (size_t i = 0; i < task.extras.object.size(); ++i)
        task.extras.object[i] = static_cast<uint32_t>(phase + 1), task.extras.depth[i] = 3;
      first.tasks[static_cast<size_t>(tile * grid.interleave().sets() + phase)] =
          TileDecoder().unpack(TileEncoder().encode(task, 1, 0).bytes,
                               {rect.width, rect.height, kDiffuseBit, kPickPlanes});
    }
  const auto picks = atRest(first, 0, {kBeauty, 0.0f})->picks;
  ASSERT_NE(picks, nullptr);
  for (int phase = 0; phase < 6; ++phase) {
    const size_t pixel = static_cast<size_t>(grid.pixelY(phase, 4)) * 100 +
                         static_cast<size_t>(grid.pixelX(phase, 7));
    EXPECT_EQ(picks->objects[pixel], static_cast<uint32_t>(phase + 1));
    EXPECT_EQ(picks->depth[pixel], 3);
  }
  EXPECT_EQ(atRest(frameOf(1, 100, 60), 1, {kBeauty, 0.0f})->picks, picks);
  EXPECT_EQ(inMotion(frameOf(2, 100, 60), {kBeauty, 0.0f})->picks, nullptr);
  EXPECT_EQ(atRest(frameOf(3, 100, 60), 0, {kBeauty, 0.0f})->picks, nullptr);
}

TEST_F(LivePictureTest, TheErrorViewIsTheFilmsErrorOverItsMean) {
  const LiveLook look{PictureView::error, 0.0f};
  Film film(100, 60);
  std::shared_ptr<const LiveImage> image;
  for (uint32_t i = 0; i < 3; ++i) {
    const GatheredFrame frame = frameOf(i, 100, 60);
    film.add(expectedMean({&frame, 1}));
    image = atRest(frame, i, look);
  }
  RgbImage mean;
  film.mean(mean);
  const std::vector<float> error = film.standardError();
  for (size_t i = 0; i < mean.count(); ++i)
    ASSERT_FLOAT_EQ(image->radiance.pixels.r[i],
                    error[i] / std::max(1e-6f, luminance(mean.rgb(i))));
  EXPECT_TRUE(image->display == codesOf(image->radiance, 0));
}

}  // namespace
}  // namespace ninefold
