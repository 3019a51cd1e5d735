#include "master/session/session.h"

#include <algorithm>

#include "common/base/log.h"
#include "common/scene/camera_choice.h"
#include "master/assembly/picture.h"
#include "master/output/run_record.h"
#include "master/output/stats.h"
#include "master/running/cluster_setup.h"

namespace ninefold {

Session::Session(const Options& options, Notice& notice, std::function<void()> wake)
    : options_(options),
      notice_(notice),
      wake_(std::move(wake)),
      loading_(std::async(std::launch::async, [&options] { return makeJob(options); })),
      input_(Clock::now()),
      board_(notice_),
      latency_(Clock::now()),
      view_(options.view),
      target_(static_cast<float>(options.frameTime)) {}

Session::~Session() = default;

bool Session::load() {
  if (live_) return true;
  if (loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  job_ = loading_.get();
  start();
  return true;
}

void Session::start() {
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
  pace.frames = options_.framesAtRest;
  live_ = std::make_unique<LiveRun>(options_, *job_, loadKeys(options_), pace,
                                    [this](const std::shared_ptr<const Shown>& shown) {
                                      const std::lock_guard lock(latencyMutex_);
                                      if (options_.stats) latency_.add(*shown);
                                      wake_();
                                    });
  editor_ = std::make_unique<Editor>(job_->scene, *live_, *camera_);
  if (auto script = scriptOf(options_, *job_->scene))
    playback_.emplace(ScriptPlayer(std::move(*script), job_->scene, job_->settings.camera),
                      options_.animate.has_value());
  live_->setView(view_);
  live_->start();
}

bool Session::isMoving() const {
  return (camera_ && camera_->isFlying()) || (playback_ && playback_->isPlaying());
}

bool Session::isOver() const {
  return live_ && (live_->cluster().signal() != 0 || live_->cluster().failure());
}

std::vector<Command> Session::step(const std::vector<WindowEvent>& events, const WindowArea& area) {
  std::vector<Command> left = input_.take(events, area.high.y - area.low.y, *camera_);
  std::erase_if(left, [&](const Command& command) { return carryOut(command, area); });
  input_.passTo(Clock::now(), *camera_);
  play();
  live_->setCamera(camera_->camera());
  takePicture();
  return left;
}

void Session::letGo() {
  input_ = WindowInput(Clock::now());
  camera_->releaseAll();
  camera_->hurry(false);
  editor_->endDrag();
}

// From the first picture on: before, there is nobody to see it.
void Session::play() {
  const Time before = std::exchange(played_, Clock::now());
  if (!playback_ || board_.shown() == nullptr) return;
  const ScriptPlayer::Step step = playback_->pass(played_ - before);
  if (step.camera) camera_->go(*step.camera);
  editor_->follow(step.edit);
}

void Session::takePicture() {
  const std::shared_ptr<const Shown> latest = live_->shown();
  if (!board_.take(latest, live_->cluster().tally().tasks.accepted)) return;
  editor_->look(*latest);
  if (exposureIsSought_) exposeByPicture();
}

std::string Session::progress(double& done) const {
  done = 0.5;
  for (const ClientInfo& client : live_->cluster().clients())
    if (client.status.state == ClientState::syncing)
      done = std::min(done, 0.1 + 0.4 * client.status.synced);
  return live_->cluster().summary();
}

bool Session::carryOut(const Command& command, const WindowArea& area) {
  using Kind = Command::Kind;
  const Vec2 place = area.share(command.pointer);
  const Shown* shown = board_.shown();
  switch (command.kind) {
    case Kind::select:
      if (shown != nullptr && area.contains(command.pointer)) editor_->pick(place, *shown);
      return true;
    case Kind::dragBegin:
      if (shown != nullptr) editor_->beginDrag(command.mode, place, *shown);
      return true;
    case Kind::drag:
      editor_->drag(place);
      return true;
    case Kind::dragEnd:
      editor_->endDrag();
      return true;
    case Kind::view:
      show(command.view);
      return true;
    case Kind::exposure:
      expose(board_.tone().exposure + command.amount);
      return true;
    case Kind::reset:
      camera_->reset();
      return true;
    case Kind::nextCamera:
      camera_->go(cameras_[nextCamera_++ % cameras_.size()]);
      return true;
    case Kind::saveView:
      keepView();
      return true;
    case Kind::togglePlay:
      if (playback_) playback_->toggle();
      return true;
    case Kind::toggleLamp:
      editor_->toggleLamp();
      return true;
    case Kind::deselect:
      editor_->deselect();
      return true;
    case Kind::undo:
      editor_->undo();
      return true;
    case Kind::redo:
      editor_->redo();
      return true;
    case Kind::frameSelection:
      camera_->frame(editor_->boundsOfSelection());
      return true;
    case Kind::saveScene:
    case Kind::savePicture:
    case Kind::togglePanel:
    case Kind::toggleKeys:
    case Kind::close:
      return false;
  }
  return false;
}

PanelView Session::panelView() const {
  PanelView view;
  board_.tell(view);
  editor_->tell(view);
  view.state = live_->cluster().summary();
  view.clients = live_->cluster().clients();
  view.steps = stepStatsOf(live_->cluster().tally());
  view.needs = describe(live_->needs());
  view.settings = live_->settings();
  view.view = view_;
  view.complete = board_.shown() != nullptr && board_.shown()->frame.last &&
                  board_.shown()->state.isSeenAs(live_->state());
  view.autoExposure = autoExposure_;
  view.target = target_;
  view.speed = camera_->speed();
  for (const Camera& camera : cameras_) view.cameras.push_back(camera.name);
  if (playback_) view.playing = playback_->isPlaying();
  return view;
}

void Session::apply(const PanelChanges& changes) {
  editor_->take(changes);
  if (changes.settings) live_->setSettings(*changes.settings);
  if (changes.view) show(*changes.view);
  if (changes.autoExposure) autoExposure_ = exposureIsSought_ = *changes.autoExposure;
  if (exposureIsSought_) exposeByPicture();
  if (changes.exposure) expose(*changes.exposure);
  if (changes.curve) setTone({board_.tone().exposure, *changes.curve});
  if (changes.target) live_->setTarget(fromSeconds(1e-3 * double(target_ = *changes.target)));
  if (changes.verticalFov) camera_->setVerticalFov(*changes.verticalFov);
  if (changes.orthographicHeight) camera_->setOrthographicHeight(*changes.orthographicHeight);
  if (changes.camera) camera_->go(cameras_[*changes.camera]);
  if (changes.saveView) keepView();
  if (changes.togglePlay) playback_->toggle();
  if (changes.savePng) board_.save("png");
  if (changes.saveExr) board_.save("exr");
  if (changes.record) board_.toggleRecording();
}

void Session::setTone(const Tone& tone) {
  board_.setTone(tone);
  live_->setTone(tone);
}

// By hand.
void Session::expose(float wanted) {
  autoExposure_ = exposureIsSought_ = false;
  setTone({std::clamp(wanted, -kMostExposure, kMostExposure), board_.tone().curve});
}

// By the first picture of light at rest that comes. From then on it holds still.
void Session::exposeByPicture() {
  const Shown* shown = board_.shown();
  if (shown == nullptr || shown->frame.moving || !isLight(shown->view)) return;
  if (shown->image->radiance.count() == 0) return;
  exposureIsSought_ = false;
  setTone({exposureByPicture(shown->image->radiance), board_.tone().curve});
}

// One more camera, in the panel, under C, and in scenes that are saved.
void Session::keepView() {
  if (cameras_.size() >= kMostCameras) return notice_.complain("no more views can be kept");
  Camera camera = camera_->camera();
  const auto isTaken = [&](const std::string& name) {
    return std::ranges::find(cameras_, name, &Camera::name) != cameras_.end();
  };
  for (int i = 1; camera.name.empty() || isTaken(camera.name); ++i)
    camera.name = fmt::format("view {}", i);
  notice_.say(fmt::format("{}: --camera {}", camera.name, specOf(*job_->scene, camera)));
  cameras_.push_back(std::move(camera));
}

Scene Session::sceneNow() const {
  Scene scene = editor_->scene();
  scene.cameras = cameras_;
  return scene;
}

void Session::setSaved() {
  editor_->setSaved();
  savedCameras_ = cameras_.size();
}

int Session::end(const std::string& reason) {
  if (!live_) return 0;
  live_->stop(reason);
  writeLast();
  if (const auto failure = live_->cluster().failure()) fail("{}", *failure);
  return live_->cluster().signal() == 0 ? 0 : 128 + live_->cluster().signal();
}

void Session::writeLast() {
  if (options_.output && board_.shown() != nullptr) {
    board_.write(*options_.output);
    log("{} frame(s) in {}", board_.shown()->frames, *options_.output);
  }
  const std::lock_guard lock(latencyMutex_);
  if (options_.stats)
    writeStats(*options_.stats, latency_.json(options_.scene, live_->cluster().tally()));
}

}  // namespace ninefold
