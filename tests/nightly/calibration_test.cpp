// The stated error is the real one. Many films of one picture, each with a seed of its own, say
// what their error is; their spread says what it was.
//
// S films of N frames have block means m_sb with stated standard errors e_sb; M_b is their mean
// over the films:
//
//   t_sb = (m_sb - M_b) / (e_sb sqrt(1 - 1/S))        Student's t with R - 1 degrees of freedom,
//                                                     R = 8 replications
//   F    = mean of e_sb^2 / variance of m_sb over s   1; its spread is sqrt(2/(S-1) + 2/(S(R-1)))
//                                                     for one block, and no larger for many
//
// t is tested by Kolmogorov and Smirnov's statistic block by block, F for blocks and pixels, and
// for what the stop rule looks at. Frames are what the programs make, codec and filter included.
// They differ in their photon radius: their variance grows a little and their mean moves a little.
// Both make the stated error larger only, by less than the tolerances. Pixels have their neighbours
// as the film takes them; blocks' means are those of unfiltered pixels.
#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>
#include <numeric>

#include "common/image/film.h"
#include "common/scene/reader.h"
#include "tests/gi/make_scene.h"
#include "tests/pipeline/one_process.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr int kFilms = 128, kFrames = 16;  // 16: where the stop rule looks first
constexpr int kWidth = 64, kHeight = 48;
constexpr double kSure = 1e-4;  // probability that a right program fails in one comparison

void add(RgbImage& image, int x, int y, float value) {
  const size_t i = image.at(x, y);
  for (auto* plane : {&image.pixels.r, &image.pixels.g, &image.pixels.b}) (*plane)[i] += value;
}

// The luminance of a frame, and of its blocks, one pixel each.
struct Grey {
  RgbImage pixels, blocks;

  explicit Grey(const RgbImage& frame) {
    pixels.reset(frame.width, frame.height);
    blocks.reset(frame.width / kErrorBlock, frame.height / kErrorBlock);
    for (int y = 0; y < frame.height; ++y)
      for (int x = 0; x < frame.width; ++x) {
        const float Y = luminance(frame.rgb(frame.at(x, y)));
        add(pixels, x, y, Y);
        add(blocks, x / kErrorBlock, y / kErrorBlock, Y / float(kErrorBlock * kErrorBlock));
      }
  }
};

// One quantity (a pixel or block) over all films.
struct Quantity {
  std::vector<double> means, errors;

  double mean() const { return std::accumulate(means.begin(), means.end(), 0.0) / kFilms; }
  double variance() const {
    double sum = 0;
    for (const double m : means) sum += (m - mean()) * (m - mean());
    return sum / (kFilms - 1);
  }
  double statedVariance() const {
    double sum = 0;
    for (const double e : errors) sum += e * e;
    return sum / kFilms;
  }
};

void take(const Film& film, std::vector<Quantity>& quantities) {
  RgbImage mean;
  film.mean(mean);
  const std::vector<float> error = film.standardError();
  quantities.resize(mean.count());
  for (size_t i = 0; i < mean.count(); ++i) {
    quantities[i].means.push_back(static_cast<double>(mean.pixels.g[i]));
    quantities[i].errors.push_back(static_cast<double>(error[i]));
  }
}

struct Films {
  std::vector<Quantity> pixels, blocks;
  double relativeError = 0;  // as the stop rule has it: root mean square over the films
};

Films manyFilms(const Scene& scene, Settings settings) {
  const Tracer tracer(scene, Isa::automatic);
  Films films;
  for (int s = 0; s < kFilms; ++s) {
    settings.seed = static_cast<uint64_t>(s) + 1;
    testing::OneProcess way(tracer, settings);
    Film film(kWidth, kHeight, {.pattern = settings.interleave});
    Film blockFilm(kWidth / kErrorBlock, kHeight / kErrorBlock);
    for (int frame = 0; frame < kFrames; ++frame) {
      const auto [unfiltered, filtered] = way.nextBoth();
      const Grey grey(unfiltered), neighbours(filtered);
      film.addTile(0, 0, grey.pixels, &neighbours.pixels), film.frameDone();
      blockFilm.add(grey.blocks);
    }
    take(film, films.pixels), take(blockFilm, films.blocks);
    films.relativeError += std::pow(film.relativeError(), 2) / kFilms;
  }
  films.relativeError = std::sqrt(films.relativeError);
  return films;
}

// P(sqrt(n) D > x) of Kolmogorov's distribution.
double kolmogorov(double x) {
  double p = 0;
  for (int k = 1; k < 100; ++k) p += (k % 2 == 1 ? 2 : -2) * std::exp(-2.0 * k * k * x * x);
  return p;
}

double studentP(const Quantity& q) {
  const boost::math::students_t student(kReplications - 1);
  std::vector<double> u;
  for (int s = 0; s < kFilms; ++s) {
    const auto i = static_cast<size_t>(s);
    u.push_back(boost::math::cdf(
        student, (q.means[i] - q.mean()) / (q.errors[i] * std::sqrt(1 - 1.0 / kFilms))));
  }
  std::sort(u.begin(), u.end());
  double d = 0;
  for (size_t i = 0; i < u.size(); ++i)
    d = std::max({d, u[i] - double(i) / kFilms, double(i + 1) / kFilms - u[i]});
  return kolmogorov(d * std::sqrt(double(kFilms)));
}

// Stated over real variance, summed over quantities.
double statedOverReal(const std::vector<Quantity>& quantities) {
  double stated = 0, real = 0;
  for (const Quantity& q : quantities) stated += q.statedVariance(), real += q.variance();
  return stated / real;
}

// relativeError() of film.h by the films' spread.
double realRelativeError(const std::vector<Quantity>& blocks) {
  double variance = 0, mean = 0;
  for (const Quantity& q : blocks) variance += q.variance(), mean += q.mean();
  const double n = static_cast<double>(blocks.size());
  return std::sqrt(variance / n) / (mean / n);
}

void expectCalibrated(const Scene& scene, Settings settings) {
  settings.width = kWidth, settings.height = kHeight;
  const Films films = manyFilms(scene, settings);
  const double spread = std::sqrt(2.0 / (kFilms - 1) + 2.0 / (kFilms * (kReplications - 1)));
  const double pixels = statedOverReal(films.pixels), blocks = statedOverReal(films.blocks);
  double worst = 1;
  for (const Quantity& q : films.blocks) worst = std::min(worst, studentP(q));
  const double rule = std::pow(films.relativeError / realRelativeError(films.blocks), 2);
  std::printf(
      "stated/real variance: pixels %.3f, blocks %.3f, stop rule %.3f; "
      "least P of t %.2g of %zu blocks\n",
      pixels, blocks, rule, worst, films.blocks.size());
  EXPECT_NEAR(pixels, 1, 4 * spread);
  EXPECT_NEAR(blocks, 1, 4 * spread);
  EXPECT_NEAR(rule, 1, 4 * spread);
  EXPECT_GT(worst, kSure / double(films.blocks.size()));
}

Settings radiosity() {
  Settings s;
  s.photons = 200;
  return s;
}

// Direct and indirect light, corners: VPLs and compensation.
TEST(Calibration, DiffuseRoom) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.6f))), Vec3(-1), Vec3(1), true);
  b.box(b.material(testing::matte(Vec3(0.7f, 0.4f, 0.2f))), Vec3(-0.5f, -1, -0.6f),
        Vec3(0, 0, -0.2f), false);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(10))), Vec3(-0.3f, 0.99f, -0.3f), Vec3(0.6f, 0, 0),
         Vec3(0, 0, 0.6f));
  b.camera(Vec3(0, 0, 0.95f), Vec3(0, -0.25f, -1), 1.2f);
  expectCalibrated(b.build(), radiosity());
}

// All estimators: a caustic, mirrors, rough metal.
TEST(Calibration, RoomWithGlassAndMetal) {
  SceneBuilder b;
  Material metal = testing::mirror(Vec3(0.9f, 0.7f, 0.4f));
  metal.roughness = 0.4f;
  b.box(b.material(testing::matte(Vec3(0.6f))), Vec3(-1), Vec3(1), true);
  b.sphere(b.material(testing::glass(1.5f)), Vec3(0.4f, -0.6f, -0.2f), 0.35f, 24);
  b.sphere(b.material(metal), Vec3(-0.5f, -0.6f, -0.3f), 0.35f, 24);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(10))), Vec3(-0.3f, 0.99f, -0.3f), Vec3(0.6f, 0, 0),
         Vec3(0, 0, 0.6f));
  b.camera(Vec3(0, 0, 0.95f), Vec3(0, -0.25f, -1), 1.2f);
  expectCalibrated(b.build(), radiosity());
}

TEST(Calibration, PathTracer) {
  Settings s;
  s.method = Method::pathTrace;
  expectCalibrated(readScene(NINEFOLD_SCENES "/table_room.glb"), s);
}

}  // namespace
}  // namespace ninefold
