#include "common/gi/light/emission.h"

#include <array>

#include "common/sampling/warp.h"

namespace ninefold {
namespace {

// A chosen emitter before its particle has a direction.
struct Source {
  const Emitter* emitter = nullptr;
  uint32_t index = 0;
  float probability = 1;
  Vec2 u;  // for the position
};

std::optional<Source> chooseSource(const Transport& t, size_t stream, Vec2 u01) {
  const auto choice = t.streams.choose(stream, u01.x);
  if (!choice) return std::nullopt;
  return Source{&t.emitters[choice->index], choice->index, choice->probability,
                Vec2(choice->remapped, u01.y)};
}

// Local sources: light that spreads from one point.
struct LocalSource {
  Vec3 position{0};
  Vec3 normal{0};  // Lambertian: emitting side; spot, goniometric: axis; point: unused
  float error = 0;
  enum class Kind { lambert, sphere, cone, table } kind = Kind::lambert;
  float oneMinusCos = 2;         // cone
  Flux flux{0};                  // lambert, table: whole flux over P
  const Scene* scene = nullptr;  // punctual
  const PunctualLight* light = nullptr;
  const ProfileSampling* table = nullptr;
  float probability = 1;  // punctual: P

  // Emitted intensity divided by P [W/sr].
  Vec3 intensity(Vec3 w) const {
    if (kind == Kind::lambert) return std::max(glm::dot(w, normal), 0.0f) * kInvPi * flux;
    return Emitters::intensity(*scene, *light, w) / probability;
  }
  float ordinaryPdf(Vec3 w) const {
    const float cosine = glm::dot(w, normal);
    if (kind == Kind::lambert) return cosineHemispherePdf(cosine);
    if (kind == Kind::sphere) return kSpherePdf;
    if (kind == Kind::table) return table->pdf(light->direction, light->across, w);
    return 1 - cosine <= oneMinusCos ? conePdf(oneMinusCos) : 0.0f;
  }
  Vec3 ordinarySample(Vec2 u) const {
    if (kind == Kind::sphere) return squareToSphere(u);
    if (kind == Kind::table) return table->sample(light->direction, light->across, u);
    const Basis frame(normal);
    return frame.toWorld(kind == Kind::lambert ? squareToCosineHemisphere(u)
                                               : squareToCone(u, oneMinusCos));
  }
  Vec3 origin(Vec3 w) const {
    return kind == Kind::lambert ? offsetOrigin(position, normal, error, w) : position;
  }
};

LocalSource localSource(const Transport& t, const Source& s, bool backSide) {
  LocalSource local;
  const Emitter& e = *s.emitter;
  if (e.kind == EmitterKind::triangle) {
    const EmitterPoint p = t.emitters.pointAt(s.index, squareToTriangle(s.u));
    local.position = p.position, local.error = p.error;
    local.normal = backSide ? -e.normal : e.normal;
    local.flux = (e.doubleSided ? 2.0f : 1.0f) * kPi * e.area / s.probability * p.radiance;
    return local;
  }
  const PunctualLight& light = t.lights[e.light];
  local.scene = &t.scene, local.light = &light;
  local.position = light.position, local.normal = light.direction;
  local.probability = s.probability;
  if (e.kind == EmitterKind::goniometric) {
    local.kind = LocalSource::Kind::table, local.table = &t.emitters.samplingOf(light);
    local.flux = e.flux / s.probability;
    return local;
  }
  local.kind = e.kind == EmitterKind::point ? LocalSource::Kind::sphere : LocalSource::Kind::cone;
  const float halfSine = std::sin(0.5f * light.outerCone);
  local.oneMinusCos = 2 * halfSine * halfSine;
  return local;
}

bool isLocal(const Emitter& e) {
  return e.kind != EmitterKind::directional && e.kind != EmitterKind::environment;
}

// One lobe of the mixture towards a target.
struct Aim {
  float weight = 0;       // relative; 0 = could not be reached, or was all around
  float oneMinusCos = 0;  // of the cone; 0 = that is so now
  Vec3 axis{0};

  bool isThere() const { return weight > 0 && oneMinusCos > 0; }
};

Aim aimAt(const Sphere& sphere, const LocalSource& source) {
  const Vec3 towards = sphere.centre - source.position;
  const float d2 = glm::dot(towards, towards), r2 = sphere.radius * sphere.radius;
  if (d2 <= r2 * 1.02f) return {};  // inside: the ordinary emission reaches it
  if (source.kind == LocalSource::Kind::lambert &&
      glm::dot(towards, source.normal) < -sphere.radius)
    return {};
  const float sin2 = r2 / d2;
  const float oneMinusCos = sin2 / (1 + std::sqrt(1 - sin2));
  return {std::sqrt(oneMinusCos), oneMinusCos, towards / std::sqrt(d2)};
}

Aim aimAt(const AimTarget& target, const LocalSource& source) {
  Aim aim = aimAt(target.now, source);
  if (!(target.begun == target.now)) aim.weight = aimAt(target.begun, source).weight;
  return aim;
}

using Aims = std::array<Aim, kMaxTargets>;

float prepareAims(const Transport& t, const LocalSource& source, Aims& aims) {
  float total = 0;
  for (size_t i = 0; i < t.targets.size(); ++i)
    total += (aims[i] = aimAt(t.targets[i], source)).weight;
  return total;
}

// Chooses a mixture component: index of a target, or -1 for the ordinary emission.
int chooseAim(const Aims& aims, size_t count, float total, float u) {
  if (total <= 0 || u < kOrdinaryShare) return -1;
  float left = (u - kOrdinaryShare) / (1 - kOrdinaryShare) * total;
  int last = -1;
  for (size_t i = 0; i < count; ++i) {
    if (aims[i].weight <= 0) continue;
    last = static_cast<int>(i);
    left -= aims[i].weight;
    if (left < 0) break;
  }
  return last;
}

float mixturePdf(const LocalSource& source, const Aims& aims, size_t count, float total, Vec3 w) {
  if (total <= 0) return source.ordinaryPdf(w);
  float aimed = 0;
  for (size_t i = 0; i < count; ++i) {
    const Aim& aim = aims[i];
    if (!aim.isThere()) continue;
    // |w - axis|^2 = 2 (1 - cos): stable for thin cones.
    const Vec3 off = w - aim.axis;
    if (0.5f * glm::dot(off, off) <= aim.oneMinusCos * 1.00001f)
      aimed += aim.weight / total * conePdf(aim.oneMinusCos);
  }
  return kOrdinaryShare * source.ordinaryPdf(w) + (1 - kOrdinaryShare) * aimed;
}

Particle aimFrom(const Transport& t, const LocalSource& source, Vec2 u, float uTarget) {
  Aims aims;
  const float total = prepareAims(t, source, aims);
  const int chosen = chooseAim(aims, t.targets.size(), total, uTarget);
  Vec3 w;
  if (chosen < 0) {
    w = source.ordinarySample(u);
  } else {
    const Aim& aim = aims[static_cast<size_t>(chosen)];
    if (!aim.isThere()) return {};
    w = Basis(aim.axis).toWorld(squareToCone(u, aim.oneMinusCos));
  }
  const float pdf = mixturePdf(source, aims, t.targets.size(), total, w);
  const Vec3 intensity = source.intensity(w);
  return {source.origin(w), w, pdf > 0 ? intensity / pdf : Vec3(0)};
}

// Parallel light of irradiance E [W/m^2] along w; the disk is outside the scene, across w.
struct Beam {
  Vec3 w{0};
  Vec3 irradiance{0};  // over P and, for the environment, over the density of w
};

Beam chooseBeam(const Transport& t, const Source& s, Vec2 u23) {
  if (s.emitter->kind == EmitterKind::directional) {
    const PunctualLight& light = t.lights[s.emitter->light];
    return {light.direction, light.intensity / s.probability};
  }
  const Vec3 from = t.emitters.sampleEnvironment(u23);
  return {-from, t.emitters.environment(from) / (t.emitters.environmentPdf(from) * s.probability)};
}

Metres diskRadius(const Transport& t) {
  constexpr float kWider = 1.0001f;
  static_assert(kWider > 1 + kBallRounding);
  return kWider * coverRadius(t.scene);
}

Vec3 beamOrigin(const Transport& t, const Beam& beam, Vec3 across) {
  const Vec3 centre = t.scene.bounds.centre();
  return centre + across - 1.01f * coverRadius(t.scene) * beam.w;
}

Particle beamParticle(const Transport& t, const Beam& beam, Vec2 u) {
  const float radius = diskRadius(t);
  const Vec2 disk = radius * squareToDisk(u);
  const Basis frame(beam.w);
  const Vec3 across = disk.x * frame.tangent + disk.y * frame.bitangent;
  return {beamOrigin(t, beam, across), beam.w, kPi * radius * radius * beam.irradiance};
}

// Where a target's centre lies across the beam, from the scene's centre.
Vec3 acrossBeam(const Transport& t, const Beam& beam, const Sphere& target) {
  const Vec3 from = target.centre - t.scene.bounds.centre();
  return from - glm::dot(from, beam.w) * beam.w;
}

Particle aimBeam(const Transport& t, const Beam& beam, Vec2 u, float uTarget) {
  const float radius = diskRadius(t);
  const Basis frame(beam.w);
  const float count = static_cast<float>(t.targets.size());
  const bool ordinary = uTarget < kOrdinaryShare;
  Vec3 centre(0);
  float spread = radius;
  if (!ordinary) {
    const float place = (uTarget - kOrdinaryShare) / (1 - kOrdinaryShare) * count;
    const Sphere& target =
        t.targets[std::min(static_cast<size_t>(place), t.targets.size() - 1)].now;
    centre = acrossBeam(t, beam, target), spread = target.radius;
  }
  const Vec2 disk = spread * squareToDisk(u);
  const Vec3 across = centre + disk.x * frame.tangent + disk.y * frame.bitangent;
  float pdf = 0;  // per m^2 across the beam
  if (glm::dot(across, across) <= radius * radius)
    pdf += kOrdinaryShare * kInvPi / (radius * radius);
  for (const AimTarget& target : t.targets) {
    const Vec3 off = across - acrossBeam(t, beam, target.now);
    const float r2 = target.now.radius * target.now.radius;
    if (glm::dot(off, off) <= r2) pdf += (1 - kOrdinaryShare) / count * kInvPi / r2;
  }
  return {beamOrigin(t, beam, across), beam.w, pdf > 0 ? beam.irradiance / pdf : Vec3(0)};
}

// Double-sided triangles spend half of u on each side.
bool takeBackSide(const Emitter& e, float& u) {
  if (!e.doubleSided) return false;
  const bool back = u >= 0.5f;
  u = std::min(2 * u - (back ? 1.0f : 0.0f), 0x1.fffffep-1f);
  return back;
}

Particle emitLocal(const Transport& t, const Source& s, Vec2 u) {
  const bool back = takeBackSide(*s.emitter, u.x);
  const LocalSource source = localSource(t, s, back);
  const Vec3 w = source.ordinarySample(u);
  const bool inProportion =
      source.kind == LocalSource::Kind::lambert || source.kind == LocalSource::Kind::table;
  if (inProportion) return {source.origin(w), w, source.flux};
  const float pdf = source.ordinaryPdf(w);
  return {source.origin(w), w, pdf > 0 ? source.intensity(w) / pdf : Vec3(0)};
}

// The particle, told what it came from.
Particle emittedBy(const Source& s, Particle particle) {
  particle.punctual =
      s.emitter->kind != EmitterKind::triangle && s.emitter->kind != EmitterKind::environment;
  particle.lamp = lampOf(*s.emitter);
  return particle;
}

}  // namespace

Particle emitParticle(const Transport& t, size_t stream, Vec2 u01, Vec2 u23) {
  const auto s = chooseSource(t, stream, u01);
  if (!s) return {};
  return emittedBy(*s, isLocal(*s->emitter) ? emitLocal(t, *s, u23)
                                            : beamParticle(t, chooseBeam(t, *s, u23), s->u));
}

Particle emitAlike(const Transport& t, size_t stream, Vec2 main, Vec2 rest) {
  const auto s = chooseSource(t, stream, main);
  if (!s) return {};
  Source source = *s;
  const Vec2 alike = source.u;
  if (source.emitter->kind == EmitterKind::directional)
    return emittedBy(source, beamParticle(t, chooseBeam(t, source, rest), alike));
  source.u = rest;
  return emittedBy(source, isLocal(*source.emitter)
                               ? emitLocal(t, source, alike)
                               : beamParticle(t, chooseBeam(t, source, alike), rest));
}

Particle emitAimed(const Transport& t, size_t stream, Vec2 u01, Vec2 u23, float uTarget) {
  if (t.targets.empty()) return emitParticle(t, stream, u01, u23);
  const auto s = chooseSource(t, stream, u01);
  if (!s) return {};
  if (!isLocal(*s->emitter))
    return emittedBy(*s, aimBeam(t, chooseBeam(t, *s, u23), s->u, uTarget));
  const bool back = takeBackSide(*s->emitter, u23.x);
  return emittedBy(*s, aimFrom(t, localSource(t, *s, back), u23, uTarget));
}

Particle emitAimed(const Transport& t, const LambertSource& source, Vec2 u, float uTarget) {
  LocalSource local;
  local.position = source.position, local.normal = source.normal, local.error = source.error;
  local.flux = source.flux;
  return aimFrom(t, local, u, uTarget);
}

}  // namespace ninefold
