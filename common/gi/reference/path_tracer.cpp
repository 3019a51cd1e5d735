#include "common/gi/reference/path_tracer.h"

#include "common/gi/light/direct_light.h"
#include "common/gi/light/light_path.h"

namespace ninefold {
namespace {

constexpr int kSureVertices = 4;

enum class Way { diffuse, reflection, transmission };

// What first turned the path after its last D vertex: by it --caustics tells light (needs.h).
enum class Turn { none, glossy, focused };

// The state of a path between vertices.
struct Path {
  Vec3 origin{0}, direction{0};
  MediumStack media;
  Vec3 throughput{1};
  float lobePdf = 0;  // density of `direction`, 0 if it was the eye's or a smooth lobe's
  int diffuseCount = 0;
  int specularRun = 0;
  Turn turn = Turn::none;
  bool startsDiffuse = false;  // the first vertex was D
  bool caustic = false;        // and what turned the path after it was focused

  // Light found now comes straight to the first D vertex.
  bool isDirect() const { return diffuseCount == 1 && turn == Turn::none; }
};

// Where light goes that a path has found.
struct Sum {
  const Transport& t;
  PathLight light{};

  void add(const Path& path, Radiance l) {
    if (path.isDirect() && t.settings.directVpls == 0) return;
    light.all += path.throughput * l;
    if (path.caustic) light.caustic += path.throughput * l;
  }
};

// f |cos| and density of the chosen way for a direction to a light.
LobeValue evaluateWay(const ShadingPoint& p, Way way, Vec3 w) {
  const bool above = glm::dot(w, p.ng) > 0;
  if (above != (way != Way::transmission)) return {};
  if (way != Way::diffuse)
    return evaluateLobe(p.bsdf, way == Way::reflection ? Lobe::reflection : Lobe::transmission,
                        p.localWo(), p.frame.toLocal(w));
  const float cosine = std::max(glm::dot(w, p.ns), 0.0f);
  return {cosine * kInvPi * p.bsdf.diffuse, cosineHemispherePdf(cosine)};
}

Radiance directAtVertex(const Transport& t, const ShadingPoint& p, const MediumStack& media,
                        Way way, size_t stream, Vec2 u, RayCounts& rays) {
  if (way != Way::diffuse && p.bsdf.isSmooth()) return Radiance(0);
  const auto light = sampleLight(t, stream, p, u);
  if (!light) return Radiance(0);
  const LobeValue value = evaluateWay(p, way, light->w);
  const Vec3 contribution = value.value * light->weight;
  if (isBlack(contribution)) return Radiance(0);
  ++rays.shadow;
  if (t.tracer.occluded(light->origin, light->segment, light->tFar)) return Radiance(0);
  const Vec3 left = lightTransmittance(t, p, media, way == Way::transmission, *light);
  return (light->pdf > 0 ? balance(light->pdf, value.pdf) : 1.0f) * left * contribution;
}

// Emission met at the end of a ray, weighted against direct light sampling at its start.
Radiance met(const Transport& t, const Path& path, const Hit& hit, const ShadingPoint& p) {
  const Radiance emitted = emittedRadiance(t, p);
  if (isBlack(emitted) || path.lobePdf == 0) return emitted;
  return balance(path.lobePdf, lightPdf(t, hit, p.surface, path.direction, hit.t)) * emitted;
}

Radiance escaped(const Transport& t, const Path& path) {
  const Radiance l = t.emitters.environment(path.direction);
  if (isBlack(l) || path.lobePdf == 0) return l;
  return balance(path.lobePdf, environmentPdf(t, path.direction)) * l;
}

Turn turnOf(const Bsdf& bsdf, Way way) {
  if (way == Way::diffuse) return Turn::none;
  if (way == Way::reflection) return isGlossy(bsdf) ? Turn::glossy : Turn::focused;
  const bool isStraight = !bsdf.dielectric || (bsdf.thin && bsdf.alpha == 0);
  return isStraight ? Turn::none : Turn::focused;
}

// Notes the way; false: --caustics leaves the path out.
bool noteTurn(const Transport& t, const Bsdf& bsdf, Way way, int vertex, Path& path) {
  if (vertex == 1) path.startsDiffuse = way == Way::diffuse;
  const Turn before = path.turn;
  if (way == Way::diffuse || before == Turn::none) path.turn = turnOf(bsdf, way);
  if (path.diffuseCount == 0) return true;
  path.caustic |= path.startsDiffuse && path.diffuseCount == 1 && path.turn == Turn::focused;
  if (t.settings.caustics == Caustics::all) return true;
  if (way == Way::diffuse) return before != Turn::focused;  // D S+ D
  return path.turn != Turn::focused || t.settings.caustics != Caustics::off;
}

// Chooses a way at p; its probability goes into the throughput. False: absorbed, or over a limit.
bool chooseWay(const Transport& t, const ShadingPoint& p, float u, int vertex, Path& path,
               Way& way) {
  const LobeChoice albedo = albedoChoice(p.bsdf, p.localWo().z);
  const float sum = albedo.sum();
  if (sum <= 0) return false;
  const float survival = vertex <= kSureVertices ? 1.0f : std::min(sum, kMaxSurvival);
  if (u >= survival) return false;
  u *= sum / survival;
  way = u < albedo.diffuse                       ? Way::diffuse
        : u < albedo.diffuse + albedo.reflection ? Way::reflection
                                                 : Way::transmission;
  const float share = way == Way::diffuse      ? albedo.diffuse
                      : way == Way::reflection ? albedo.reflection
                                               : albedo.transmission;
  if (share <= 0 || !noteTurn(t, p.bsdf, way, vertex, path)) return false;
  path.throughput *= sum / (share * survival);
  path.specularRun = way == Way::diffuse ? 0 : path.specularRun + 1;
  path.diffuseCount += way == Way::diffuse ? 1 : 0;
  return way == Way::diffuse ? t.allows(path.diffuseCount)
                             : path.specularRun <= t.settings.specularDepth;
}

// Scatters into a new direction. False: no light goes there.
bool scatter(const Transport& t, const ShadingPoint& p, Way way, Vec2 u, float uLobe, Path& path) {
  Vec3 w;
  if (way == Way::diffuse) {
    const Vec3 local = squareToCosineHemisphere(u);
    w = Basis(p.ns).toWorld(local);
    path.throughput *= p.bsdf.diffuse;
    path.lobePdf = cosineHemispherePdf(local.z);
  } else {
    const auto sample =
        sampleLobe(p.bsdf, way == Way::reflection ? Lobe::reflection : Lobe::transmission,
                   p.localWo(), u, uLobe);
    if (!sample) return false;
    w = p.frame.toWorld(sample->wi);
    path.throughput *= sample->weight;
    path.lobePdf = sample->pdf;
  }
  w = glm::normalize(w);
  if ((glm::dot(w, p.ng) > 0) != (way != Way::transmission)) return false;
  if (way == Way::transmission) path.media = t.shader.pass(p, path.media);
  path.origin = offsetOrigin(p.surface, w), path.direction = w;
  return !isBlack(path.throughput);
}

}  // namespace

PathLight scatteredLight(const Transport& t, const ShadingPoint& first, const MediumStack& media,
                         const PixelSampler& sampler, RayCounts& rays) {
  Path path;
  path.media = media;
  ShadingPoint p = first;
  Sum sum{t};
  for (int vertex = 1; vertex < kMaxVertices; ++vertex) {
    const uint32_t d = 8 * static_cast<uint32_t>(vertex);
    Way way{};
    if (!chooseWay(t, p, sampler.get1D(d + 2), vertex, path, way)) break;
    for (size_t stream = 0; stream < t.streams.count(); ++stream)
      sum.add(path, directAtVertex(t, p, path.media, way, stream, sampler.get2D(d + 4), rays));
    if (!scatter(t, p, way, sampler.get2D(d), sampler.get1D(d + 3), path)) break;
    ++rays.eye;
    const Hit hit =
        t.tracer.closest(path.origin, path.direction, std::numeric_limits<float>::infinity());
    if (!hit) {
      sum.add(path, escaped(t, path));
      break;
    }
    p = t.shader.shade(t.tracer.surface(hit), -path.direction, path.media);
    path.throughput *= t.shader.attenuation(p, path.media, hit.t);
    sum.add(path, met(t, path, hit, p));
  }
  return sum.light;
}

}  // namespace ninefold
