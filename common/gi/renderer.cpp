#include "common/gi/renderer.h"

#include "common/gi/light_check.h"
#include "common/gi/methods.h"

namespace ninefold {

struct Renderer::Impl {
  // What all cameras share.
  struct Light {
    Transport transport;
    std::unique_ptr<const GiMethod> method;

    Light(const Tracer& tracer, const Settings& settings, const Light* begun, const Light* before)
        : transport(tracer, settings, begun != nullptr ? &begun->transport : nullptr),
          method(makeMethod(transport, begun != nullptr ? begun->method.get() : nullptr,
                            before != nullptr ? before->method.get() : nullptr)) {}
  };
  std::shared_ptr<const Light> light;
  View view;

  Impl(std::shared_ptr<const Light> l, const Settings& settings)
      : light(std::move(l)), view(viewOf(light->transport, settings)) {}

  // Those of the light, seen from here.
  Settings settings() const {
    Settings seen = light->transport.settings;
    seen.camera = view.camera, seen.width = view.width, seen.height = view.height;
    return seen;
  }
  // Those that the light of a frame is made for.
  std::vector<View> lightViews(const FrameKey& frame) const {
    if (frame.lightCameras.empty()) return {view};
    std::vector<View> views;
    Settings seen = settings();
    for (const Camera& camera : frame.lightCameras) {
      seen.camera = camera;
      views.push_back(viewOf(light->transport, seen));
    }
    return views;
  }
};

Renderer::Renderer(const Tracer& tracer, const Settings& settings, const Renderer* begun,
                   const Renderer* before)
    : impl_(std::make_unique<Impl>(
          std::make_shared<const Impl::Light>(
              tracer, settings, begun != nullptr ? begun->impl_->light.get() : nullptr,
              before != nullptr ? before->impl_->light.get() : nullptr),
          settings)) {}

Renderer::Renderer(const Renderer& lit, const Settings& settings)
    : impl_(std::make_unique<Impl>(lit.impl_->light, settings)) {}

Renderer::~Renderer() = default;

std::shared_ptr<const FrameLight> Renderer::light(const FrameKey& frame, int set,
                                                  const MethodState* state) const {
  auto light = impl_->light->method->light(frame, set, impl_->lightViews(frame), state);
#ifndef NDEBUG
  const Transport& t = impl_->light->transport;
  checkLight(*light, frame, set, t.tracer.scene(), impl_->settings());
#endif
  return light;
}

StepResult Renderer::step(const StatePages& pages, const StepKey& step, uint32_t unit) const {
  return impl_->light->method->step(pages, step, unit, impl_->view);
}

std::shared_ptr<const MethodState> Renderer::digest(const StatePages& pages,
                                                    const MethodState* before) const {
  return impl_->light->method->digest(pages, before);
}

void Renderer::render(const Task& task, const FrameLight& light, Scratch& scratch,
                      TileResult& out) const {
  impl_->light->method->render(impl_->view, task, light, scratch, out);
#ifndef NDEBUG
  const Transport& t = impl_->light->transport;
  checkLight(out, task, t.tracer.scene(), impl_->settings());
#endif
}

std::unique_ptr<Scratch> Renderer::makeScratch() const {
  return impl_->light->method->makeScratch();
}

}  // namespace ninefold
