// master_benchmark: what a pixel costs the master, kernel by kernel, beside its floor: the memory
// traffic that it cannot do without (names that end in Traffic). One thread, one tile of 96 x 96
// pixels with its neighbourhood, in cache as in a run. The column "per_pixel" is seconds.
#include <benchmark/benchmark.h>

#include <random>

#include "common/image/denoise.h"
#include "common/image/film.h"
#include "common/image/irradiance_history.h"
#include "common/image/patch_filter.h"
#include "common/image/tone_map.h"
#include "proto/tile_codec.h"

namespace ninefold {
namespace {

constexpr int kPixels = 96 * 96;
const TileGrid kGrid(288, 288, {3, 3});
constexpr int kMiddle = 4;  // of 3 x 3 tiles

// A wall with a texture and noise, as a client would send it: diffuse layer only.
TileResult task(int phase) {
  std::mt19937 random(static_cast<uint32_t>(phase));
  std::uniform_real_distribution<float> uniform(0, 1);
  TileResult tile;
  tile.reset(kTaskSide, kTaskSide, kDiffuseBit, 0);
  LayerPlanes& layer = tile.layers[kDiffuse];
  for (size_t i = 0; i < kTaskSide * kTaskSide; ++i) {
    layer.distance[i] = 3 + 0.001f * static_cast<float>(i % kTaskSide);
    layer.normal.b[i] = 1;
    for (auto* plane : {&layer.irradiance.r, &layer.irradiance.g, &layer.irradiance.b})
      (*plane)[i] = 1 + 0.1f * uniform(random);
    for (auto* plane : {&layer.reflectance.r, &layer.reflectance.g, &layer.reflectance.b})
      (*plane)[i] = 0.2f + 0.05f * uniform(random);
  }
  return tile;
}

std::vector<Bytes> encoded(int level) {
  std::vector<Bytes> all;
  for (int phase = 0; phase < 9; ++phase)
    all.push_back(TileEncoder().encode(task(phase), static_cast<uint64_t>(phase), level).bytes);
  return all;
}

void fill(Patch& patch, const std::vector<UnpackedTile>& tasks) {
  patch.reset({kGrid, kDiffuseBit, 0}, kMiddle);
  patch.lighten(kDiffuseBit);
  for (int tile = 0; tile < 9; ++tile)
    for (int phase = 0; phase < 9; ++phase) {
      const Patch::Overlap part = patch.overlap(phase, kGrid.rect(tile, phase));
      tasks[static_cast<size_t>(phase)].copy(
          {part.fromI, part.fromJ, part.to, part.width, part.height}, kDiffuseBit, 0, Patch::kSide,
          patch.phase(phase));
    }
}

std::vector<UnpackedTile> unpacked(int level) {
  TileDecoder decoder;
  std::vector<UnpackedTile> tasks;
  for (Bytes& bytes : encoded(level))
    tasks.push_back(decoder.unpack(std::move(bytes), {kTaskSide, kTaskSide, kDiffuseBit, 0}));
  return tasks;
}

void perPixel(benchmark::State& state) {
  state.counters["per_pixel"] = benchmark::Counter(
      kPixels, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void Unpack(benchmark::State& state) {
  const std::vector<Bytes> bytes = encoded(static_cast<int>(state.range(0)));
  TileDecoder decoder;
  for (auto _ : state)
    for (const Bytes& task : bytes)
      benchmark::DoNotOptimize(
          decoder.unpack(Bytes(task), {kTaskSide, kTaskSide, kDiffuseBit, 0}).bytes());
  perPixel(state);
}
BENCHMARK(Unpack)->ArgName("level")->Arg(0)->Arg(1);

void Decode(benchmark::State& state) {
  const std::vector<UnpackedTile> tasks = unpacked(0);
  Patch patch;
  for (auto _ : state) {
    fill(patch, tasks);
    benchmark::ClobberMemory();
  }
  perPixel(state);
}
BENCHMARK(Decode);

// Of a wall without U: 12 planes of codes in, 10 of floats out.
void DecodeTraffic(benchmark::State& state) {
  constexpr size_t kCodes = 12, kFloats = 10, kRoom = 9 * size_t{Patch::kPixels};
  const std::vector<std::vector<uint8_t>> codes(kCodes, std::vector<uint8_t>(kRoom, 1));
  std::vector<std::vector<float>> planes(kFloats, std::vector<float>(kRoom));
  for (auto _ : state) {
    for (size_t p = 0; p < kFloats; ++p) {
      const uint8_t *one = codes[p].data(),
                    *two = codes[p < kCodes - kFloats ? kFloats + p : p].data();
      float* to = planes[p].data();
#pragma GCC ivdep
      for (size_t i = 0; i < kRoom; ++i) to[i] = static_cast<float>(one[i] ^ two[i]);
    }
    benchmark::ClobberMemory();
  }
  perPixel(state);
}
BENCHMARK(DecodeTraffic);

void Filter(benchmark::State& state) {
  Patch patch;
  fill(patch, unpacked(0));
  PatchFilter filter(SurfaceTest::surface);
  RgbImage beauty;
  const Camera camera{"", Vec3(0), Vec3(0, 0, -1), Vec3(0, 1, 0), 0.8f};
  for (auto _ : state) {
    filter.compose(patch, camera, 1, beauty);
    benchmark::ClobberMemory();
  }
  perPixel(state);
}
BENCHMARK(Filter);

// Reuse while the eye moves (1: by two pixels) or rests (0), without the filter that is before it.
void Reuse(benchmark::State& state) {
  Patch patch;
  fill(patch, unpacked(0));
  PatchFilter filter(SurfaceTest::surface);
  filter.keepIrradiance(true);
  RgbImage beauty;
  Camera camera{"", Vec3(0), Vec3(0, 0, -1), Vec3(0, 1, 0), 0.8f};
  filter.compose(patch, camera, 1, beauty);
  IrradianceHistory history;
  history.begin(camera, kGrid.width(), kGrid.height());
  history.blend(patch, filter, true, beauty);
  history.frameDone();
  const bool moving = state.range(0) != 0;
  if (moving) camera.eye.x += 0.018f;
  history.begin(camera, kGrid.width(), kGrid.height());
  for (auto _ : state) {
    history.blend(patch, filter, moving, beauty);
    benchmark::ClobberMemory();
  }
  perPixel(state);
}
BENCHMARK(Reuse)->ArgName("moving")->Arg(0)->Arg(1);

// 17 planes in, 3 out.
void FilterTraffic(benchmark::State& state) {
  std::vector<std::vector<float>> planes(17, std::vector<float>(9 * Patch::kPixels, 1.0f));
  std::vector<std::vector<float>> out(3, std::vector<float>(9 * Patch::kPixels));
  for (auto _ : state) {
    for (size_t c = 0; c < 3; ++c) {
      float* to = out[c].data();
      std::copy(planes[c].begin(), planes[c].end(), to);
      for (size_t p = 3 + c; p < planes.size(); p += 3) {
        const float* from = planes[p].data();
#pragma GCC ivdep
        for (size_t i = 0; i < out[c].size(); ++i) to[i] += from[i];
      }
    }
    benchmark::ClobberMemory();
  }
  perPixel(state);
}
BENCHMARK(FilterTraffic);

// The film of a 1920 x 1080 picture, tile after tile: from memory.
void FilmTile(benchmark::State& state) {
  Film film(1920, 1056, {.error = false});
  RgbImage tile;
  tile.reset(96, 96);
  int next = 0;
  for (auto _ : state) {
    film.addTile(next % 20 * 96, next / 20 * 96, tile);
    next = (next + 1) % 220;
  }
  perPixel(state);
}
BENCHMARK(FilmTile);

// 3 planes of a tile in, 3 of doubles from memory and back.
void FilmTraffic(benchmark::State& state) {
  RgbImage tile;
  tile.reset(96, 96);
  std::vector<std::vector<double>> sums(3, std::vector<double>(1920 * 1056));
  const std::array planes = {tile.pixels.r.data(), tile.pixels.g.data(), tile.pixels.b.data()};
  size_t next = 0;
  for (auto _ : state) {
    for (size_t y = 0; y < 96; ++y)
      for (size_t c = 0; c < 3; ++c) {
        double* to = &sums[c][(next / 20 * 96 + y) * 1920 + next % 20 * 96];
        const float* from = planes[c] + y * 96;
#pragma GCC ivdep
        for (size_t x = 0; x < 96; ++x) to[x] += static_cast<double>(from[x]);
      }
    next = (next + 1) % 220;
  }
  perPixel(state);
}
BENCHMARK(FilmTraffic);

RgbImage randomTile(float least, float most) {
  RgbImage tile;
  tile.reset(96, 96);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(least, most);
  for (auto* plane : {&tile.pixels.r, &tile.pixels.g, &tile.pixels.b})
    for (float& value : *plane) value = uniform(random);
  return tile;
}

void ToneMapTile(benchmark::State& state) {
  const RgbImage tile = randomTile(0, 1.5f);
  DisplayImage codes;
  for (auto _ : state) {
    ToneMap().apply(tile, codes);
    benchmark::ClobberMemory();
  }
  perPixel(state);
}
BENCHMARK(ToneMapTile);

// 3 planes of floats in, as many bytes out.
void ToneMapTraffic(benchmark::State& state) {
  const RgbImage tile = randomTile(0, 255);
  std::vector<uint8_t> codes(3 * kPixels);
  for (auto _ : state) {
    const float *r = tile.pixels.r.data(), *g = tile.pixels.g.data(), *b = tile.pixels.b.data();
#pragma GCC ivdep
    for (size_t i = 0; i < kPixels; ++i)
      codes[3 * i] = static_cast<uint8_t>(r[i]), codes[3 * i + 1] = static_cast<uint8_t>(g[i]),
                codes[3 * i + 2] = static_cast<uint8_t>(b[i]);
    benchmark::ClobberMemory();
  }
  perPixel(state);
}
BENCHMARK(ToneMapTraffic);

// A tile that a client has filtered, from its bytes to a display of 1920 pixels a row: as radiance
// that is tone mapped here, or as codes.
RgbImage filteredTile() { return randomTile(0.4f, 0.5f); }

void ShowRadiance(benchmark::State& state) {
  const Bytes bytes =
      TileEncoder().encode(filteredTile(), 1, static_cast<int>(state.range(0))).bytes;
  TileDecoder decoder;
  RgbImage tile;
  std::vector<uint8_t> display(3 * 1920 * 96);
  for (auto _ : state) {
    decoder.unpack(Bytes(bytes), {96, 96, kRadianceMask, 0}).copyRadiance(tile);
    const ToneMap toneMap;
    for (int y = 0; y < 96; ++y)
      toneMap.apply(tile.pixels, tile.at(0, y), 96, &display[size_t{3 * 1920} * size_t(y)]);
    benchmark::ClobberMemory();
  }
  perPixel(state);
}
BENCHMARK(ShowRadiance)->ArgName("level")->Arg(0)->Arg(1);

void ShowCodes(benchmark::State& state) {
  const Bytes bytes =
      TileEncoder().encode(filteredTile(), ToneMap(), static_cast<int>(state.range(0))).bytes;
  TileDecoder decoder;
  std::vector<uint8_t> display(3 * 1920 * 96);
  for (auto _ : state) {
    decoder.unpack(Bytes(bytes), {96, 96, kDisplayMask, 0}).copyDisplay(1920, display.data());
    benchmark::ClobberMemory();
  }
  perPixel(state);
}
BENCHMARK(ShowCodes)->ArgName("level")->Arg(0)->Arg(1);

// The last touch of a whole picture, whose noise is as large as its error says.
void Denoise(benchmark::State& state) {
  constexpr int kWidth = 640, kHeight = 480;
  constexpr size_t kCount = size_t{kWidth} * kHeight;
  std::mt19937 random(1);
  std::normal_distribution<float> noise(1, 0.1f);
  RgbImage picture;
  picture.reset(kWidth, kHeight);
  for (auto* plane : {&picture.pixels.r, &picture.pixels.g, &picture.pixels.b})
    for (float& v : *plane) v = noise(random);
  DenoiseGuides guides;
  guides.albedo.assign(kCount, 0.5f), guides.nearness.assign(kCount, 0.3f);
  guides.normal.resize(kCount), guides.normal.b.assign(kCount, 1.0f);
  const std::vector<float> errors(kCount, 0.06f);
  for (auto _ : state) {
    RgbImage touched = picture;
    denoise(touched, errors, guides, static_cast<int>(state.range(0)));
    benchmark::DoNotOptimize(touched);
  }
}
BENCHMARK(Denoise)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime()->Unit(
    benchmark::kMillisecond);

}  // namespace
}  // namespace ninefold

BENCHMARK_MAIN();
