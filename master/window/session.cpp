#include "master/window/session.h"

#include <algorithm>
#include <filesystem>

#include "common/base/log.h"
#include "common/scene/camera_choice.h"
#include "master/assembly/picture.h"
#include "master/output/output_files.h"
#include "master/output/run_record.h"
#include "master/output/stats.h"
#include "master/running/cluster_setup.h"
#include "master/running/headless.h"
#include "master/running/invitation.h"
#include "master/running/script_run.h"
#include "master/window/overlays.h"

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

WindowSession::WindowSession(const Options& options, Window& window, const WindowMemory& memory)
    : options_(options),
      window_(window),
      loading_(std::async(std::launch::async, [&options] { return makeJob(options); })),
      input_(Clock::now()),
      board_(notice_),
      saving_(
          options.scene, [this] { return sceneNow(); },
          [this] {
            editor_->setSaved();
            savedCameras_ = cameras_.size();
          },
          notice_),
      latency_(Clock::now()),
      view_(options.view),
      target_(static_cast<float>(options.frameTime)),
      memory_(memory) {}

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
  savedCameras_ = cameras_.size();
  board_.setTone({job_->exposure.value_or(0), options_.toneCurve});
  autoExposure_ = exposureIsSought_ = !job_->exposure;
  camera_ = std::make_unique<CameraControl>(job_->settings.camera, job_->scene->bounds);
  LiveRun::Pace pace{fromSeconds(1e-3 * double(target_)), true, board_.tone().exposure,
                     board_.tone().curve};
  // An exposure that is not known yet is made of radiance.
  pace.codesOnly = wantsCodesOnly(options_) && job_->exposure;
  pace.person = true;
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
  tellTitle();
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
    editor_->look(*latest);
    if (exposureIsSought_) exposeByPicture();
  }
  board_.draw(*job_->scene, editor_->selection(), window_);
}

// How far the picture is, of which scene, and whether that has changes (*) that no file has.
void WindowSession::tellTitle() {
  std::string title = "ninefold";
  if (const Shown* shown = board_.shown())
    title += shown->frame.moving
                 ? ": moving"
                 : fmt::format(": {} frame{}", shown->frames, shown->frames == 1 ? "" : "s");
  title += " - " + std::filesystem::path(options_.scene).filename().string();
  if (editor_ && (!editor_->isSaved() || savedCameras_ != cameras_.size())) title += "*";
  if (title != std::exchange(title_, title)) window_.setTitle(title);
}

void WindowSession::redraw() {
  window_.beginFrame(column_);
  if (!live_) {
    drawProgress("reading " + options_.scene, 0.05);
  } else if (board_.shown() == nullptr) {
    double done = 0;
    const std::string state = progressOf(live_->cluster(), done);
    drawProgress(state, done);
  } else {
    drawPanelAndOverlays();
  }
  if (keys_) {
    WindowArea area;
    keys_ = drawKeys(area);
    window_.cover(area);
  }
  if (const auto notice = notice_.text(Clock::now())) drawNotice(*notice);
  window_.size(memory_.width, memory_.height);
  window_.endFrame();
}

void WindowSession::drawPanelAndOverlays() {
  column_ = 0;
  if (panel_) {
    const PanelChanges changes = drawPanel(panelView());
    window_.cover(changes.area);
    memory_.folded = changes.folded;
    if (!changes.folded) column_ = changes.area.high.x + changes.area.low.x;
    apply(changes);
  }
  saving_.draw(window_);
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
      return expose(board_.tone().exposure + command.amount);
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
    case Kind::toggleKeys:
      keys_ = !keys_;
      return;
    case Kind::close:
      return window_.close();
    case Kind::saveScene:
      return saving_.save();
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
  view.steps = stepStatsOf(live_->cluster().tally());
  view.needs = describe(live_->needs());
  view.settings = live_->settings();
  view.view = view_;
  view.autoExposure = autoExposure_;
  view.folded = memory_.folded;
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
  if (changes.autoExposure) autoExposure_ = exposureIsSought_ = *changes.autoExposure;
  if (exposureIsSought_) exposeByPicture();
  if (changes.exposure) expose(*changes.exposure);
  if (changes.curve) setTone({board_.tone().exposure, *changes.curve});
  if (changes.target) live_->setTarget(fromSeconds(1e-3 * double(target_ = *changes.target)));
  if (changes.verticalFov) camera_->setVerticalFov(*changes.verticalFov);
  if (changes.camera) camera_->go(cameras_[*changes.camera]);
  if (changes.saveView) keepView();
  if (changes.togglePlay) playback_->toggle();
  if (changes.savePng) board_.save("png");
  if (changes.saveExr) board_.save("exr");
  if (changes.saveScene) saving_.save();
  if (changes.record) board_.toggleRecording();
}

void WindowSession::setTone(const Tone& tone) {
  board_.setTone(tone);
  live_->setTone(tone);
}

// By hand.
void WindowSession::expose(float wanted) {
  autoExposure_ = exposureIsSought_ = false;
  setTone({std::clamp(wanted, -kMostExposure, kMostExposure), board_.tone().curve});
}

// By the first picture of light at rest that comes. From then on it holds still.
void WindowSession::exposeByPicture() {
  const Shown* shown = board_.shown();
  if (shown == nullptr || shown->frame.moving || !isLight(shown->view)) return;
  if (shown->image->radiance.count() == 0) return;
  exposureIsSought_ = false;
  setTone({exposureByPicture(shown->image->radiance), board_.tone().curve});
}

// One more camera, in the panel, under C, and in scenes that are saved.
void WindowSession::keepView() {
  Camera camera = camera_->camera();
  const auto isTaken = [&](const std::string& name) {
    return std::ranges::find(cameras_, name, &Camera::name) != cameras_.end();
  };
  for (int i = 1; camera.name.empty() || isTaken(camera.name); ++i)
    camera.name = fmt::format("view {}", i);
  notice_.say(fmt::format("{}: --camera {}", camera.name, specOf(*job_->scene, camera)));
  cameras_.push_back(std::move(camera));
}

Scene WindowSession::sceneNow() const {
  Scene scene = editor_->scene();
  scene.cameras = cameras_;
  return scene;
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
  const auto memoryAt = memoryFile(processVariable);
  const WindowMemory memory = memoryAt ? recall(*memoryAt) : WindowMemory{};
  std::optional<Window> window;
  try {
    window.emplace("ninefold", options.settings.width, options.settings.height, memory);
  } catch (const NoDisplay& none) {
    if (!options.output)
      fail("{}; start from a desktop, or give --output FILE to render without a window",
           none.what());
    warn("{}; going on without a window", none.what());
    Options headless = options;
    headless.window = false;
    return isLive(headless) ? runScript(headless) : runHeadless(headless);
  }
  WindowSession session(options, *window, memory);
  const int status = session.run();
  if (memoryAt) remember(session.memory(), *memoryAt);
  return status;
}

}  // namespace ninefold
