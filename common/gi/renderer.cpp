#include "common/gi/renderer.h"

#include "common/gi/tile_renderer.h"

namespace ninefold {
namespace {

// Solids around the eye: those whose back face a ray to the outside meets first, from the inside
// out.
MediumStack mediaAround(const Transport& t, Vec3 eye) {
  std::vector<int> outwards;
  MediumStack entered;
  Vec3 origin = eye;
  const Vec3 direction = glm::normalize(Vec3(0.3f, 0.9f, 0.2f));
  for (int i = 0; i < 64; ++i) {
    const Hit hit = t.tracer.closest(origin, direction, std::numeric_limits<float>::infinity());
    if (!hit) break;
    const SurfacePoint s = t.tracer.surface(hit);
    const bool fromFront = glm::dot(direction, s.geometricNormal) < 0;
    t.shader.forEachCrossed(s, fromFront, [&](int material, bool enters) {
      if (enters)
        entered.enter(material);
      else if (entered.contains(material))
        entered.leave(material);
      else
        outwards.push_back(material);
    });
    origin = offsetOrigin(s, direction);
  }
  MediumStack media;
  for (auto it = outwards.rbegin(); it != outwards.rend(); ++it) media.enter(*it);
  return media;
}

// An eye exactly on a surface would see nothing but it, at no distance.
Settings offSurfaces(const Tracer& tracer, Settings settings) {
  settings.camera.eye = tracer.clearOf(settings.camera.eye, settings.camera.forward);
  return settings;
}

}  // namespace

struct Renderer::Impl {
  Transport transport;
  MediumStack eyeMedia;
  int pathsLog2;

  Impl(const Tracer& tracer, const Settings& settings)
      : transport(tracer, offSurfaces(tracer, settings)),
        eyeMedia(mediaAround(transport, transport.settings.camera.eye)),
        pathsLog2(settings.method == Method::instantRadiosity ? lightPathsLog2(transport) : -1) {}
};

Renderer::Renderer(const Tracer& tracer, const Settings& settings)
    : impl_(std::make_unique<Impl>(tracer, settings)) {}

Renderer::~Renderer() = default;

std::shared_ptr<const LightSet> Renderer::lightSet(const FrameKey& frame, int k) const {
  if (impl_->transport.settings.method == Method::pathTrace)
    return std::make_shared<const LightSet>();
  return std::make_shared<const LightSet>(
      makeLightSet(impl_->transport, frame, k, impl_->pathsLog2));
}

void Renderer::render(const Task& task, const LightSet& lights, Scratch& scratch,
                      TileResult& out) const {
  renderTask(impl_->transport, impl_->eyeMedia, task, lights, scratch, out);
}

std::unique_ptr<Scratch, void (*)(Scratch*)> Renderer::makeScratch() const {
  return {new Scratch, [](Scratch* scratch) { delete scratch; }};
}

}  // namespace ninefold
