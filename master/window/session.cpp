#include "master/window/session.h"

#include <algorithm>

#include "common/base/log.h"
#include "common/scene/camera_choice.h"
#include "common/scene/gltf_writer.h"
#include "master/cluster_setup.h"
#include "master/headless.h"
#include "master/invitation.h"
#include "master/output_files.h"
#include "master/script_run.h"
#include "master/stats.h"

namespace ninefold {
namespace {

constexpr Duration kIdle = milliseconds(100);  // between two looks when nothing happens
constexpr Duration kMoving = milliseconds(8);  // while keys are held or a script plays

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
      board_(options.exposure),
      latency_(Clock::now()),
      view_(options.view),
      target_(static_cast<float>(options.frameTime)) {}

WindowSession::~WindowSession() = default;

int WindowSession::run() {
  while (!window_.shouldClose()) {
    if (live_ && (live_->cluster().signal() != 0 || live_->cluster().failure())) break;
    step();
  }
  if (!live_) return 0;
  live_->stop("the window was closed");
  writeLast();
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
  cameras_ = job_->scene->cameras;
  camera_ = std::make_unique<CameraControl>(job_->settings.camera, job_->scene->bounds);
  const LiveRun::Pace pace{fromSeconds(1e-3 * double(target_)), true, board_.exposure(),
                           wantsCodesOnly(options_)};
  live_ = std::make_unique<LiveRun>(options_, *job_, loadKeys(options_), pace,
                                    [this](const std::shared_ptr<const Shown>& shown) {
                                      const std::lock_guard lock(latencyMutex_);
                                      if (options_.stats) latency_.add(*shown);
                                      Window::wake();
                                    });
  editor_ = std::make_unique<Editor>(job_->scene, *live_, *camera_);
  if (auto script = scriptOf(options_, *job_->scene))
    playback_.emplace(ScriptPlayer(std::move(*script), job_->scene, job_->settings.camera),
                      options_.animate.has_value());
  live_->setView(view_);
  live_->start();
}

void WindowSession::step() {
  const bool moving = (camera_ && camera_->isFlying()) || (playback_ && playback_->isPlaying());
  window_.wait(moving ? kMoving : kIdle);
  const std::vector<WindowEvent> events = window_.takeEvents();
  if (load()) {
    const WindowArea area = window_.pictureArea();
    for (const Command& command : input_.take(events, area.high.y - area.low.y, *camera_))
      carryOut(command);
    input_.passTo(Clock::now(), *camera_);
    play();
    live_->setCamera(camera_->camera());
    takePicture();
  }
  redraw();
}

// From the first picture on: before, there is nobody to see it.
void WindowSession::play() {
  const Time before = std::exchange(played_, Clock::now());
  if (!playback_ || board_.shown() == nullptr) return;
  const ScriptPlayer::Step step = playback_->pass(played_ - before);
  if (step.camera) camera_->go(*step.camera);
  editor_->follow(step.edit);
}

void WindowSession::takePicture() {
  const std::shared_ptr<const Shown> latest = live_->shown();
  if (board_.take(latest, live_->cluster().tally().tasks.accepted)) {
    window_.setTitle(latest->frame.moving ? "ninefold: moving"
                                          : fmt::format("ninefold: {} frame(s)", latest->frames));
    editor_->look(*latest);
  }
  board_.draw(*job_->scene, editor_->selection(), window_);
}

void WindowSession::redraw() {
  window_.beginFrame();
  if (!live_) {
    drawProgress("reading " + options_.scene, 0.05);
  } else if (board_.shown() == nullptr) {
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
  const WindowArea area = window_.pictureArea();
  const Vec2 place = area.share(command.pointer);
  const Shown* shown = board_.shown();
  switch (command.kind) {
    case Kind::select:
      if (shown != nullptr && area.contains(command.pointer)) editor_->pick(place, *shown);
      return;
    case Kind::dragBegin:
      if (shown != nullptr) editor_->beginDrag(command.mode, place, *shown);
      return;
    case Kind::drag:
      return editor_->drag(place);
    case Kind::dragEnd:
      return editor_->endDrag();
    case Kind::view:
      return show(command.view);
    case Kind::exposure:
      return expose(board_.exposure() + command.amount);
    case Kind::reset:
      return camera_->reset();
    case Kind::nextCamera:
      return camera_->go(cameras_[nextCamera_++ % cameras_.size()]);
    case Kind::saveView:
      return keepView();
    case Kind::togglePlay:
      if (playback_) playback_->toggle();
      return;
    case Kind::toggleLamp:
      return editor_->toggleLamp();
    case Kind::deselect:
      return editor_->deselect();
    case Kind::undo:
      return editor_->undo();
    case Kind::redo:
      return editor_->redo();
    case Kind::savePicture:
      return board_.save("png");
    case Kind::togglePanel:
      panel_ = !panel_;
      return;
    case Kind::close:
      return window_.close();
    case Kind::saveScene:
      return saveScene();
    case Kind::frameSelection:
      return camera_->frame(editor_->boundsOfSelection());
  }
}

PanelView WindowSession::panelView() const {
  PanelView view;
  board_.tell(view);
  editor_->tell(view);
  view.state = live_->cluster().summary();
  view.clients = live_->cluster().clients();
  view.needs = describe(live_->needs());
  view.settings = live_->settings();
  view.view = view_;
  view.target = target_;
  view.speed = camera_->speed();
  for (const Camera& camera : cameras_) view.cameras.push_back(camera.name);
  if (playback_) view.playing = playback_->isPlaying();
  return view;
}

void WindowSession::apply(const PanelChanges& changes) {
  editor_->take(changes);
  if (changes.settings) live_->setSettings(*changes.settings);
  if (changes.view) show(*changes.view);
  if (changes.exposure) expose(*changes.exposure);
  if (changes.target) live_->setTarget(fromSeconds(1e-3 * double(target_ = *changes.target)));
  if (changes.verticalFov) camera_->setVerticalFov(*changes.verticalFov);
  if (changes.camera) camera_->go(cameras_[*changes.camera]);
  if (changes.saveView) keepView();
  if (changes.togglePlay) playback_->toggle();
  if (changes.savePng) board_.save("png");
  if (changes.saveExr) board_.save("exr");
  if (changes.saveScene) saveScene();
  if (changes.record) board_.toggleRecording();
}

void WindowSession::expose(float wanted) {
  const float exposure = std::clamp(wanted, -kMostExposure, kMostExposure);
  board_.expose(exposure);
  live_->setExposure(exposure);
}

// One more camera, in the panel, under C, and in scenes that are saved.
void WindowSession::keepView() {
  Camera camera = camera_->camera();
  const auto isTaken = [&](const std::string& name) {
    return std::ranges::find(cameras_, name, &Camera::name) != cameras_.end();
  };
  for (int i = 1; camera.name.empty() || isTaken(camera.name); ++i)
    camera.name = fmt::format("view {}", i);
  log("{}: --camera {}", camera.name, specOf(*job_->scene, camera));
  cameras_.push_back(std::move(camera));
}

void WindowSession::saveScene() {
  const std::string path = fmt::format("edited.{:04}.glb", ++saved_);
  Scene scene = editor_->scene();
  scene.cameras = cameras_;
  try {
    writeGltf(path, scene);
    log("the edited scene is in {}", path);
  } catch (const Error& error) {
    warn("{}", error.what());
  }
}

void WindowSession::writeLast() {
  if (options_.output && board_.shown() != nullptr) {
    board_.write(*options_.output);
    log("{} frame(s) in {}", board_.shown()->frames, *options_.output);
  }
  const std::lock_guard lock(latencyMutex_);
  if (options_.stats)
    writeStats(*options_.stats, latency_.json(options_.scene, live_->cluster().tally()));
}

int runWindow(const Options& options) {
  checkGuests(options);
  checkFiles(options);
  std::optional<Window> window;
  try {
    const int height = std::max(480, options.settings.height);
    window.emplace("ninefold", std::max(720, options.settings.width), height);
  } catch (const NoDisplay& none) {
    if (!options.output)
      fail("{}; start from a desktop, or give --output FILE to render without a window",
           none.what());
    warn("{}; going on without a window", none.what());
    Options headless = options;
    headless.window = false;
    return isLive(headless) ? runScript(headless) : runHeadless(headless);
  }
  WindowSession session(options, *window);
  return session.run();
}

}  // namespace ninefold
