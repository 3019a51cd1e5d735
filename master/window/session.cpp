#include "master/window/session.h"

#include "common/base/log.h"
#include "common/image/image_file.h"
#include "common/scene/gltf_writer.h"
#include "master/cluster_setup.h"
#include "master/headless.h"
#include "master/window/picking.h"

namespace ninefold {
namespace {

constexpr Duration kIdle = milliseconds(100);  // between two looks when nothing happens
constexpr Duration kFlying = milliseconds(8);  // while keys are held
constexpr size_t kTimesShown = 120;

// Numbers 1 .. 9, 0 as they stand on the keyboard.
PictureView viewOfDigit(int digit) { return static_cast<PictureView>(digit == 0 ? 9 : digit - 1); }

std::string progressOf(const Cluster& cluster, double& done) {
  done = 0.5;
  for (const ClientInfo& client : cluster.clients())
    if (client.status.state == ClientState::syncing)
      done = std::min(done, 0.1 + 0.4 * client.status.synced);
  return cluster.summary();
}

}  // namespace

WindowSession::WindowSession(const Options& options, Window& window)
    : options_(options),
      window_(window),
      loading_(std::async(std::launch::async, [&options] { return makeJob(options); })),
      input_(Clock::now()),
      view_(options.view),
      exposure_(options.exposure),
      target_(static_cast<float>(options.frameTime)) {}

WindowSession::~WindowSession() = default;

int WindowSession::run() {
  while (!window_.shouldClose()) {
    if (live_ && (live_->cluster().signal() != 0 || live_->cluster().failure())) break;
    step();
  }
  if (!live_) return 0;
  live_->stop("the window was closed");
  saveLast();
  if (const auto failure = live_->cluster().failure()) fail("{}", *failure);
  return live_->cluster().signal() == 0 ? 0 : 128 + live_->cluster().signal();
}

bool WindowSession::load() {
  if (live_) return true;
  if (loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  job_ = loading_.get();
  start();
  return true;
}

void WindowSession::start() {
  camera_ = std::make_unique<CameraControl>(job_->settings.camera, job_->scene->bounds);
  history_ = std::make_unique<EditHistory>(job_->scene);
  const LiveRun::Pace pace{fromSeconds(1e-3 * double(target_)), true};
  live_ = std::make_unique<LiveRun>(options_, *job_, loadKeys(options_), pace,
                                    [](const auto&) { Window::wake(); });
  live_->setView(view_);
  live_->start();
}

void WindowSession::step() {
  window_.wait(camera_ && camera_->isFlying() ? kFlying : kIdle);
  const std::vector<WindowEvent> events = window_.takeEvents();
  if (load()) {
    const WindowArea area = window_.pictureArea();
    for (const Command& command : input_.take(events, area.high.y - area.low.y, *camera_))
      carryOut(command);
    input_.passTo(Clock::now(), *camera_);
    live_->setCamera(camera_->camera());
    takePicture();
  }
  redraw();
}

void WindowSession::redraw() {
  window_.beginFrame();
  if (!live_) {
    drawProgress("reading " + options_.scene, 0.05);
  } else if (!shown_) {
    double done = 0;
    const std::string state = progressOf(live_->cluster(), done);
    drawProgress(state, done);
  } else if (panel_) {
    apply(drawPanel(panelView()));
  }
  window_.endFrame();
}

void WindowSession::carryOut(const Command& command) {
  using Kind = Command::Kind;
  switch (command.kind) {
    case Kind::select:
      return drag_ ? drag_.reset() : pick(command.pointer);
    case Kind::dragBegin:
      return beginDrag(command);
    case Kind::drag:
      return moveDrag(command);
    case Kind::dragEnd:
      return drag_.reset();
    case Kind::view:
      view_ = viewOfDigit(static_cast<int>(command.amount));
      return live_->setView(view_);
    case Kind::exposure:
      exposure_ += command.amount;
      return showCodes();
    case Kind::reset:
      return camera_->reset();
    case Kind::nextCamera:
      return camera_->go(job_->scene->cameras[nextCamera_++ % job_->scene->cameras.size()]);
    case Kind::toggleLamp:
      return toggleLamp();
    case Kind::deselect:
      selection_.reset();
      return live_->wantObjects(false);
    case Kind::undo:
      return step(history_->undo());
    case Kind::redo:
      return step(history_->redo());
    case Kind::savePicture:
      return savePicture("png");
    case Kind::togglePanel:
      panel_ = !panel_;
      return;
    case Kind::close:
      return window_.close();
    case Kind::saveScene:
      return saveScene();
    case Kind::frameSelection:
      return camera_->frame(
          selection_ ? boundsOfNode(edited(*job_->scene, history_->all()), selection_->node)
                     : Bounds{});
  }
}

// --- pictures ---

void WindowSession::takePicture() {
  const std::shared_ptr<const Shown> latest = live_->shown();
  if (latest == shown_) return;
  if (shown_)
    frameTimes_.push_back(
        static_cast<float>(1e3 * seconds(latest->completed - latest->frame.opened)));
  if (frameTimes_.size() > kTimesShown) frameTimes_.erase(frameTimes_.begin());
  const double past = seconds(latest->completed - ratesAt_);
  if (past > 0.5) {
    const uint64_t rays = latest->rays.total(), tasks = live_->cluster().tally().tasks.accepted;
    raysPerSecond_ = static_cast<double>(rays - raysThen_) / past;
    tasksPerSecond_ = static_cast<double>(tasks - tasksThen_) / past;
    raysThen_ = rays, tasksThen_ = tasks, ratesAt_ = latest->completed;
  }
  shown_ = latest;
  window_.setTitle(latest->frame.moving ? "ninefold: moving"
                                        : fmt::format("ninefold: {} frame(s)", latest->frames));
  if (pick_) resolvePick();
  showCodes();
  if (recording_) savePicture("png");
}

void WindowSession::showCodes() {
  if (!shown_) return;
  std::vector<uint8_t> rgb;
  const float exposure = isFalseColor(shown_->view) ? 0 : exposure_;
  if (!toneMap_ || toneMapFor_ != exposure) toneMap_.emplace(exposure), toneMapFor_ = exposure;
  toneMap_->apply(shown_->image, rgb);
  if (selection_) drawOutline(*shown_, *job_->scene, *selection_, rgb);
  window_.setPicture(rgb, shown_->image.width, shown_->image.height);
}

void WindowSession::savePicture(const std::string& extension) {
  if (!shown_) return;
  const std::string path = recording_ ? fmt::format("record.{:04}.{}", ++recorded_, extension)
                                      : fmt::format("ninefold.{:04}.{}", ++saved_, extension);
  try {
    writeImage(path, {shown_->image, {}, {}}, ToneMap(exposure_));
    log("picture in {}", path);
  } catch (const Error& error) {
    warn("{}", error.what());
    recording_ = false;
  }
}

void WindowSession::saveScene() {
  const std::string path = fmt::format("edited.{:04}.glb", ++saved_);
  try {
    writeGltf(path, edited(*job_->scene, history_->all()));
    log("the edited scene is in {}", path);
  } catch (const Error& error) {
    warn("{}", error.what());
  }
}

void WindowSession::saveLast() const {
  if (!options_.output || !shown_) return;
  writeImage(*options_.output, {shown_->image, {}, {}}, ToneMap(exposure_));
  log("{} frame(s) in {}", shown_->frames, *options_.output);
}

// --- selecting and editing ---

Vec2 WindowSession::filmPosition(Vec2 pointer, int width, int height) const {
  return window_.pictureArea().toPicture(pointer, width, height);
}

void WindowSession::pick(Vec2 pointer) {
  if (!shown_ || !window_.pictureArea().contains(pointer)) return;
  const WindowArea area = window_.pictureArea();
  pick_ = (pointer - area.low) / (area.high - area.low);
  live_->wantObjects(true);
  resolvePick();
}

void WindowSession::resolvePick() {
  if (shown_->objects.empty()) return;  // a frame that has them will come
  const Vec2 size(static_cast<float>(shown_->image.width),
                  static_cast<float>(shown_->image.height));
  const Vec2 film = *pick_ * size;
  pick_.reset();
  const std::optional<uint32_t> instance = instanceAt(*shown_, film);
  if (!instance) {
    selection_.reset();
    return live_->wantObjects(false);
  }
  select(*instance);
  if (const auto point = pointAt(*shown_, film)) camera_->setPivot(*point);
  showCodes();
}

void WindowSession::select(uint32_t instance) {
  const Instance& thing = job_->scene->instances[instance];
  const Mesh& mesh = job_->scene->meshes[static_cast<size_t>(thing.mesh)];
  selection_ = Selection{thing.node, thing.name, static_cast<uint32_t>(mesh.material), {}};
  ++action_;
  log("selected {}", thing.name);
}

void WindowSession::beginDrag(const Command& command) {
  if (!selection_ || selection_->light || !shown_ || shown_->objects.empty()) return;
  const auto point =
      pointAt(*shown_, filmPosition(command.pointer, shown_->image.width, shown_->image.height));
  if (!point) return;
  SceneEdit thing;
  thing.objects.push_back({selection_->node, DMat4(1)});
  const DMat4 before = history_->valuesNow(thing).objects[0].motion;
  const Settings full = live_->settings();
  drag_.emplace(command.mode, *point, boundsOfNode(*job_->scene, selection_->node, before).centre(),
                filmPosition(command.pointer, full.width, full.height), before);
  ++action_;
}

void WindowSession::moveDrag(const Command& command) {
  if (!drag_) return;
  const Settings full = live_->settings();  // frames in motion may be smaller
  SceneEdit moved;
  moved.objects.push_back(
      {selection_->node, drag_->moveTo(filmPosition(command.pointer, full.width, full.height),
                                       camera_->camera(), full.width, full.height)});
  edit(moved);
}

// A lamp is a punctual light, or a surface that emits; off is black, on is as it was read.
void WindowSession::toggleLamp() {
  if (!selection_) return;
  SceneEdit now;
  if (selection_->light) {
    now.lights.push_back(editOf(*job_->scene, *selection_->light));
    LightEdit lamp = history_->valuesNow(now).lights[0];
    lamp.intensity = isBlack(lamp.intensity) ? now.lights[0].intensity : Vec3(0);
    now.lights[0] = lamp;
  } else {
    now.materials.push_back(editOfMaterial(*job_->scene, selection_->material));
    MaterialEdit lamp = history_->valuesNow(now).materials[0];
    lamp.emission = isBlack(lamp.emission) ? now.materials[0].emission : Vec3(0);
    now.materials[0] = lamp;
  }
  ++action_;
  edit(now);
}

void WindowSession::edit(const SceneEdit& edit) {
  try {
    checkEdit(*job_->scene, edit);
  } catch (const Error& error) {
    return warn("{}", error.what());
  }
  history_->apply(edit, action_);
  live_->edit(edit);
}

void WindowSession::step(std::optional<SceneEdit> undone) {
  if (undone) live_->edit(*undone);
  ++action_;
}

// --- the panel ---

PanelView WindowSession::panelView() const {
  PanelView view;
  view.shown = shown_.get();
  view.frameTimes = frameTimes_;
  view.raysPerSecond = raysPerSecond_, view.tasksPerSecond = tasksPerSecond_;
  view.state = live_->cluster().summary();
  view.clients = live_->cluster().clients();
  view.needs = describe(live_->needs());
  view.settings = live_->settings();
  view.view = view_;
  view.exposure = exposure_, view.target = target_;
  view.speed = camera_->speed();
  view.recording = recording_;
  view.selection = selection_;
  for (const PunctualLight& light : job_->scene->lights)
    view.lights.push_back("lamp " + light.name);
  for (const Camera& camera : job_->scene->cameras) view.cameras.push_back(camera.name);
  if (!selection_) return view;
  SceneEdit thing;
  if (selection_->light) thing.lights.push_back(editOf(*job_->scene, *selection_->light));
  thing.materials.push_back(editOfMaterial(*job_->scene, selection_->material));
  const SceneEdit now = history_->valuesNow(thing);
  view.material = now.materials[0];
  if (selection_->light) view.light = now.lights[0];
  return view;
}

void WindowSession::apply(const PanelChanges& changes) {
  if (changes.settings) live_->setSettings(*changes.settings);
  if (changes.view) live_->setView(view_ = *changes.view);
  if (changes.exposure) exposure_ = *changes.exposure, showCodes();
  if (changes.target) live_->setTarget(fromSeconds(1e-3 * double(target_ = *changes.target)));
  if (changes.verticalFov) camera_->setVerticalFov(*changes.verticalFov);
  if (changes.camera) camera_->go(job_->scene->cameras[*changes.camera]);
  if (changes.selectLight)
    selection_ =
        Selection{-1, job_->scene->lights[*changes.selectLight].name, 0, *changes.selectLight};
  SceneEdit turned;
  if (changes.material) turned.materials.push_back(*changes.material);
  if (changes.light) turned.lights.push_back(*changes.light);
  if (!turned.empty()) edit(turned);
  if (changes.sliderReleased && !drag_) ++action_;
  if (changes.undo) step(history_->undo());
  if (changes.redo) step(history_->redo());
  if (changes.savePng) savePicture("png");
  if (changes.saveExr) savePicture("exr");
  if (changes.saveScene) saveScene();
  if (changes.record) recording_ = !recording_;
}

int runWindow(const Options& options) {
  if (options.output) checkOutputPath(*options.output);
  std::optional<Window> window;
  try {
    const int height = std::max(480, options.settings.height);
    window.emplace("ninefold", std::max(720, options.settings.width), height);
  } catch (const NoDisplay& none) {
    warn("{}; going on without a window", none.what());
    return runHeadless(options);
  }
  WindowSession session(options, *window);
  return session.run();
}

}  // namespace ninefold
