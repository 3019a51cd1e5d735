#include "common/gi/renderer.h"

#include "common/gi/light_check.h"
#include "common/gi/tile_renderer.h"

namespace ninefold {
namespace {

// Solids around the eye: those whose back face a ray to the outside meets first.
MediumStack mediaAround(const Transport& t, Vec3 eye) {
  MediumStack media, entered;
  Vec3 origin = eye;
  const Vec3 direction = glm::normalize(Vec3(0.3f, 0.9f, 0.2f));
  for (int i = 0; i < 64; ++i) {
    const Hit hit = t.tracer.closest(origin, direction, std::numeric_limits<float>::infinity());
    if (!hit) break;
    const SurfacePoint s = t.tracer.surface(hit);
    const bool fromFront = glm::dot(direction, s.geometricNormal) < 0;
    t.shader.forEachCrossed(s, fromFront, [&](int material, bool enters) {
      if (enters)
        t.shader.enter(entered, material);
      else if (entered.contains(material))
        entered.leave(material);
      else
        t.shader.enter(media, material);
    });
    origin = offsetOrigin(s, direction);
  }
  return media;
}

// An eye exactly on a surface would see nothing but it, at no distance.
View viewOf(const Transport& t, const Settings& s) {
  View view{s.camera, s.width, s.height, {}};
  view.camera.eye = t.tracer.clearOf(s.camera.eye, s.camera.forward);
  view.eyeMedia = mediaAround(t, view.camera.eye);
  return view;
}

}  // namespace

struct Renderer::Impl {
  // What all cameras share.
  struct Light {
    Transport transport;
    int pathsLog2;

    Light(const Tracer& tracer, const Settings& settings, const Light* begun)
        : transport(tracer, settings, begun != nullptr ? &begun->transport : nullptr),
          pathsLog2(begun != nullptr && begun->pathsLog2 >= 0     ? begun->pathsLog2
                    : settings.method == Method::instantRadiosity ? lightPathsLog2(transport)
                                                                  : -1) {}
  };
  std::shared_ptr<const Light> light;
  View view;

  Impl(std::shared_ptr<const Light> l, const Settings& settings)
      : light(std::move(l)), view(viewOf(light->transport, settings)) {}
};

Renderer::Renderer(const Tracer& tracer, const Settings& settings, const Renderer* begun)
    : impl_(std::make_unique<Impl>(
          std::make_shared<const Impl::Light>(
              tracer, settings, begun != nullptr ? begun->impl_->light.get() : nullptr),
          settings)) {}

Renderer::Renderer(const Renderer& lit, const Settings& settings)
    : impl_(std::make_unique<Impl>(lit.impl_->light, settings)) {}

Renderer::~Renderer() = default;

std::shared_ptr<const LightSet> Renderer::lightSet(const FrameKey& frame, int k) const {
  if (impl_->light->transport.settings.method == Method::pathTrace)
    return std::make_shared<const LightSet>();
  auto lights = std::make_shared<const LightSet>(
      makeLightSet(impl_->light->transport, frame, k, impl_->light->pathsLog2));
#ifndef NDEBUG
  const Transport& t = impl_->light->transport;
  checkLight(*lights, frame, k, t.tracer.scene(), t.settings);
#endif
  return lights;
}

void Renderer::render(const Task& task, const LightSet& lights, Scratch& scratch,
                      TileResult& out) const {
  const Transport& t = impl_->light->transport;
  renderTask(t, impl_->view, task, lights, scratch, out);
#ifndef NDEBUG
  Settings seen = t.settings;
  seen.camera = impl_->view.camera, seen.width = impl_->view.width,
  seen.height = impl_->view.height;
  checkLight(out, task, t.tracer.scene(), seen);
#endif
}

std::unique_ptr<Scratch, void (*)(Scratch*)> Renderer::makeScratch() const {
  return {new Scratch, [](Scratch* scratch) { delete scratch; }};
}

}  // namespace ninefold
