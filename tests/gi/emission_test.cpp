// Particles carry the emitters' power: the mean flux of many equals the whole, whether they start
// in the ordinary way or aimed at a specular object, for every kind of emitter.
#include "common/gi/light/emission.h"

#include <gtest/gtest.h>

#include "common/gi/radiosity/radiosity.h"
#include "common/gi/renderer.h"
#include "common/gi/vpl/indirect_vpls.h"
#include "common/sampling/sampler.h"
#include "common/scene/methods.h"
#include "tests/gi/make_scene.h"
#include "tests/gi/render.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

enum class Kind { area, doubleSided, point, spot, directional, goniometric, environment };

Scene lit(Kind kind) {
  SceneBuilder b;
  b.sphere(b.material(testing::glass(1.5f)), Vec3(0.5f, -0.3f, 0.2f), 0.3f, 16);
  b.sphere(b.material(testing::mirror()), Vec3(-0.5f, 0.3f, 0.4f), 0.1f, 16);
  PunctualLight light;
  light.position = Vec3(0, 1, 0), light.direction = glm::normalize(Vec3(0.2f, -1, 0.1f));
  light.intensity = Vec3(3), light.innerCone = 0.3f, light.outerCone = 0.9f;
  if (kind == Kind::area || kind == Kind::doubleSided) {
    Material lamp = testing::matte(Vec3(0), Vec3(4));
    lamp.doubleSided = kind == Kind::doubleSided;
    b.quad(b.material(lamp), Vec3(-0.5f, 1, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1));
  }
  light.kind = kind == Kind::point  ? LightKind::point
               : kind == Kind::spot ? LightKind::spot
                                    : LightKind::directional;
  if (kind == Kind::point || kind == Kind::spot || kind == Kind::directional) b.light(light);
  if (kind == Kind::goniometric)
    b.goniometric(light, {0, 30, 90, 120}, {0, 90, 360}, [](float theta, float phi) {
      return theta == 120 ? 0.0f : phi == 90 ? 1.0f : theta == 30 ? 0.0f : 0.25f;
    });
  if (kind == Kind::environment) b.environment(Radiance(2));
  return b.build();
}

// Of the rows of the goniometric light: the integral over phi, in degrees. Columns 0 and 360 are
// alike, and phi = 90 is 1 but for the last row: 360 (1 + a)/2 with a = 1/4, 0, 1/4, and 0.
double rowIntegral(double theta) {
  const double rows[] = {225, 180, 225, 0}, at[] = {0, 30, 90, 120};
  for (int i = 0; i < 3; ++i)
    if (theta <= at[i + 1])
      return rows[i] + (rows[i + 1] - rows[i]) * (theta - at[i]) / (at[i + 1] - at[i]);
  return 0;
}

// Flux by quadrature or formula [W], independent of the table.
double wholeFlux(const Scene& scene, Kind kind) {
  const double R = 1.0001 * scene.bounds.radius(), pi = std::acos(-1.0);
  switch (kind) {
    case Kind::area:
      return pi * 4;
    case Kind::doubleSided:
      return 2 * pi * 4;
    case Kind::point:
      return 4 * pi * 3;
    case Kind::directional:
      return pi * R * R * 3;
    case Kind::environment:
      return 4 * pi * pi * R * R * 2;
    case Kind::goniometric: {
      double sum = 0;
      constexpr int kSteps = 100000;
      for (int i = 0; i < kSteps; ++i) {
        const double theta = 120 * (i + 0.5) / kSteps;
        sum += 3 * rowIntegral(theta) * (pi / 180) * std::sin(theta * pi / 180);
      }
      return sum * (120 * pi / 180) / kSteps;
    }
    default:
      break;
  }
  const double inner = std::cos(0.3), outer = std::cos(0.9);  // spot: integral of the falloff
  double sum = 0;
  constexpr int kSteps = 100000;
  for (int i = 0; i < kSteps; ++i) {
    const double c = outer + (1 - outer) * (i + 0.5) / kSteps;
    const double ramp = std::min((c - outer) / (inner - outer), 1.0);
    sum += 2 * pi * 3 * ramp * ramp * (1 - outer) / kSteps;
  }
  return sum;
}

struct Mean {
  double value, error;
};

template <typename Emit>
Mean meanFlux(Emit&& emit) {
  constexpr uint32_t kBatches = 64, kEach = 1024;
  double sum = 0, squares = 0;
  for (uint32_t batch = 0; batch < kBatches; ++batch) {
    const LightSampler sampler(1, SampleUse::photon, batch, 0, 10, Randomization::owen);
    double mean = 0;
    for (uint32_t i = 0; i < kEach; ++i)
      mean += static_cast<double>(emit(sampler, i).flux.x) / kEach;
    sum += mean, squares += mean * mean;
  }
  const double mean = sum / kBatches;
  return {mean, std::sqrt(std::max(squares / kBatches - mean * mean, 0.0) / (kBatches - 1))};
}

TEST(Emission, MeanFluxIsTheEmittersPower) {
  for (const Kind kind : {Kind::area, Kind::doubleSided, Kind::point, Kind::spot, Kind::directional,
                          Kind::goniometric, Kind::environment}) {
    const Scene scene = lit(kind);
    const Tracer tracer(scene, Isa::automatic);
    Settings settings;
    settings.environment = scene.environment;
    const Transport t(tracer, settings);
    ASSERT_GE(t.targets.size(), 2u);
    const double whole = wholeFlux(scene, kind);
    const Mean ordinary = meanFlux([&](const LightSampler& s, uint32_t i) {
      return emitParticle(t, 0, s.get2D(i, 0), s.get2D(i, 2));
    });
    EXPECT_NEAR(ordinary.value, whole, 4 * ordinary.error + 1e-4 * whole) << static_cast<int>(kind);
    const Mean aimed = meanFlux([&](const LightSampler& s, uint32_t i) {
      return emitAimed(t, 0, s.get2D(i, 0), s.get2D(i, 2), s.get1D(i, 4));
    });
    EXPECT_NEAR(aimed.value, whole, 4 * aimed.error + 1e-4 * whole)
        << "aimed " << static_cast<int>(kind);
    EXPECT_LT(aimed.error, 0.02 * whole);
  }
}

TEST(Emission, AimedParticlesMostlyMeetTheirTargets) {
  const Scene scene = lit(Kind::area);
  const Tracer tracer(scene, Isa::automatic);
  const Transport t(tracer, Settings{});
  const LightSampler sampler(1, SampleUse::photon, 0, 0, 10, Randomization::owen);
  int ordinary = 0, aimed = 0;
  for (uint32_t i = 0; i < 1024; ++i) {
    const Particle p = emitParticle(t, 0, sampler.get2D(i, 0), sampler.get2D(i, 2));
    const Particle q =
        emitAimed(t, 0, sampler.get2D(i, 0), sampler.get2D(i, 2), sampler.get1D(i, 4));
    ordinary += tracer.occluded(p.origin, p.direction, 100) ? 1 : 0;
    aimed += tracer.occluded(q.origin, q.direction, 100) ? 1 : 0;
  }
  EXPECT_GT(aimed, 5 * ordinary);
}

TEST(Emission, NoFluxExceedsTheOrdinaryOneByMoreThanItsShareAllows) {
  const Scene scene = lit(Kind::area);
  const Tracer tracer(scene, Isa::automatic);
  const Transport t(tracer, Settings{});
  const LightSampler sampler(2, SampleUse::photon, 0, 0, 12, Randomization::owen);
  for (uint32_t i = 0; i < 4096; ++i) {
    const Particle p =
        emitAimed(t, 0, sampler.get2D(i, 0), sampler.get2D(i, 2), sampler.get1D(i, 4));
    EXPECT_LE(p.flux.x, 4 * kPi / kOrdinaryShare * 1.001f);
  }
}

// A diffuse scene needs no photon and traces none; its light sets hold VPLs only.
TEST(LightSet, DiffuseSceneTracesNoPhoton) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.5f))), Vec3(-1), Vec3(1), true);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(5))), Vec3(-0.2f, 0.9f, -0.2f), Vec3(0.4f, 0, 0),
         Vec3(0, 0, 0.4f));
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  const Transport t(tracer, Settings{});
  EXPECT_EQ(layerMaskOf(t.needs, Method::instantRadiosity), kDiffuseBit);
  const LightSet set =
      makeLightSet(t, FrameKey{0, 0, 0, 0.1f}, 0, lightPathsLog2(t, t.settings.indirectVpls));
  for (const PhotonGrid& grid : set.photons) EXPECT_TRUE(grid.empty());
  EXPECT_GT(set.vpls.size(), 8u);
}

// Any order, any instance: the same set, bit for bit.
TEST(LightSet, IsAFunctionOfItsKeyAlone) {
  const Scene scene = lit(Kind::area);
  const Tracer tracer(scene, Isa::automatic), other(scene, Isa::automatic);
  const Transport a(tracer, Settings{}), b(other, Settings{});
  const int m = lightPathsLog2(a, 18);
  EXPECT_EQ(m, lightPathsLog2(b, 18));
  for (int k = 8; k >= 0; --k) {
    const FrameKey key{5, 5, 5, 0.1f};
    const LightSet first = makeLightSet(a, key, k, m);
    makeLightSet(b, key, (k + 3) % 9, m);
    const LightSet second = makeLightSet(b, key, k, m);
    ASSERT_EQ(first.vpls.size(), second.vpls.size());
    for (size_t i = 0; i < first.vpls.size(); ++i) {
      EXPECT_EQ(first.vpls[i].position, second.vpls[i].position);
      EXPECT_EQ(first.vpls[i].power, second.vpls[i].power);
    }
    for (size_t kind = 0; kind < kPhotonKinds; ++kind) {
      const auto one = first.photons[kind].photons(), two = second.photons[kind].photons();
      ASSERT_EQ(one.size(), two.size());
      for (size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].flux, two[i].flux);
    }
  }
}

TEST(ProbeClass, IsTheSameEveryTimeAndTellsInstructionSetsApartOnlyByTheirBytes) {
  EXPECT_EQ(probeClass(Isa::avx2), probeClass(Isa::avx2));
  EXPECT_EQ(probeClass(Isa::automatic).size(), 16u);
}

}  // namespace
}  // namespace ninefold
