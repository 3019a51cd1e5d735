#include "master/web/web_session.h"

#include <filesystem>

#include "common/base/standard_streams.h"
#include "common/image/encode.h"
#include "common/image/image_file.h"
#include "master/output/metrics.h"
#include "master/output/output_files.h"
#include "master/running/invitation.h"
#include "master/web/web_setup.h"
#include "master/web/web_state.h"

namespace ninefold {
namespace {

constexpr Duration kIdle = milliseconds(100);        // between two looks when nothing happens
constexpr Duration kMoving = milliseconds(8);        // while keys are held or a script plays
constexpr Duration kOfferEvery = milliseconds(200);  // without a new picture

// Numbers of things that are not there change nothing: they may have been there when it was said.
std::optional<PanelChanges> changesOf(const FromViewer& said, const Session& session) {
  PanelChanges changes;
  if (const auto* view = std::get_if<said::View>(&said.what)) {
    changes.view = view->view;
  } else if (const auto* exposure = std::get_if<said::Exposure>(&said.what)) {
    changes.exposure = exposure->ev;
    if (!exposure->ev) changes.autoExposure = true;
  } else if (const auto* lamp = std::get_if<said::Lamp>(&said.what)) {
    if (lamp->number < session.panelView().lights.size()) changes.selectLight = lamp->number;
  } else if (const auto* to = std::get_if<said::GoTo>(&said.what)) {
    if (to->camera < session.panelView().cameras.size()) changes.camera = to->camera;
  } else {
    return std::nullopt;
  }
  return changes;
}

}  // namespace

WebSession::WebSession(const Options& options, WebSetup setup)
    : scene_(std::filesystem::path(options.scene).stem().string()),
      server_(std::move(setup)),
      session_(options, notice_, [this] { server_.wake(); }) {}

int WebSession::run() {
  while (!session_.isOver()) step();
  return session_.end("the master ends");
}

void WebSession::step() {
  const std::vector<FromViewer> all = server_.take(session_.isMoving() ? kMoving : kIdle);
  const bool isLoaded = session_.load();
  for (const FromViewer& one : all) hear(one);
  if (isLoaded) {
    session_.step(std::exchange(events_, {}), area_);  // the master saves only what it is told to
    see();
    sendFiles();
  }
  events_.clear();
  if (isNew_ || Clock::now() - offered_ >= kOfferEvery) offer();
}

void WebSession::hear(const FromViewer& said) {
  if (const auto* size = std::get_if<said::Size>(&said.what)) area_.high = size->size;
  if (const auto* event = std::get_if<said::Event>(&said.what)) events_.push_back(event->event);
  if (const auto* wish = std::get_if<said::Download>(&said.what))
    wishes_.push_back({said.viewer, wish->kind});
  if (!session_.isLoaded()) return;
  if (std::holds_alternative<NewHand>(said.what)) {
    events_.clear();
    return session_.letGo();
  }
  if (const auto changes = changesOf(said, session_)) session_.apply(*changes);
}

void WebSession::see() {
  const DisplayImage* drawn = session_.draw();
  if (drawn == nullptr || drawn->empty()) return;
  const Shown& shown = *session_.board().shown();
  picture_ = std::make_shared<WebPicture>(*drawn, shown.frame.moving ? 0 : shown.frames);
  isNew_ = true;
}

// Radiance waits for a picture that has it.
void WebSession::sendFiles() {
  const Shown* shown = session_.board().shown();
  if (shown == nullptr) return;
  const bool hasRadiance = shown->image->radiance.count() > 0;
  std::erase_if(wishes_, [&](const Wish& wish) {
    if (wish.kind == said::Download::Kind::exr && !hasRadiance) return false;
    server_.send(wish.viewer, std::make_shared<const WebBody>(fileOf(wish.kind)));
    return true;
  });
}

WebBody WebSession::fileOf(said::Download::Kind kind) {
  PictureBoard& board = session_.board();
  if (kind == said::Download::Kind::exr)
    return {"image/x-exr", scene_ + ".exr", encodeExr({board.shown()->image->radiance, {}, {}})};
  const DisplayImage& codes = board.display();
  return {"image/png", scene_ + ".png", encodePng(codes.width, codes.height, 3, codes.rgb)};
}

void WebSession::offer() {
  server_.offer({picture_, state(), metrics()});
  offered_ = Clock::now();
  isNew_ = false;
}

std::string WebSession::state() const {
  if (!session_.isLoaded()) return progressText(scene_, "reading the scene");
  double ignored = 0;
  if (session_.board().shown() == nullptr) return progressText(scene_, session_.progress(ignored));
  return stateText(session_.panelView(), scene_, notice_.text(Clock::now()).value_or(""));
}

std::string WebSession::metrics() const {
  RunMetrics run;
  if (session_.isLoaded()) {
    run.tally = session_.cluster().tally();
    run.clients = session_.cluster().clients();
  }
  const Shown* shown = session_.board().shown();
  run.relativeError =
      shown != nullptr ? shown->relativeError : std::numeric_limits<double>::quiet_NaN();
  if (shown != nullptr && !shown->frame.moving) run.framesInPicture = shown->frames;
  const WebCounts web = server_.counts();
  run.viewers = web.viewers, run.viewersRefused = web.refused, run.bytesToViewers = web.bytesSent;
  return metricsText(run);
}

int runWeb(const Options& options) {
  checkGuests(options);
  checkFiles(options);
  const WebSetup setup = webSetup(options);
  WebSession session(options, setup);
  const std::string& host = setup.listen.host;
  const auto addresses = isAnyAddress(host) ? addressesBehind(host) : std::vector<std::string>();
  for (const std::string& line : webInvitation(options, setup, session.port(), addresses))
    sayToPeople(line + "\n");  // with the token, which no log is to have
  return session.run();
}

}  // namespace ninefold
