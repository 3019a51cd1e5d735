#include "master/window/session.h"

#include <filesystem>

#include "common/base/log.h"
#include "master/output/output_files.h"
#include "master/running/headless.h"
#include "master/running/invitation.h"
#include "master/running/script_run.h"
#include "master/window/overlays.h"
#include "master/window/panel.h"

namespace ninefold {
namespace {

constexpr Duration kIdle = milliseconds(100);  // between two looks when nothing happens
constexpr Duration kMoving = milliseconds(8);  // while keys are held or a script plays

}  // namespace

WindowSession::WindowSession(const Options& options, Window& window, const WindowMemory& memory)
    : options_(options),
      window_(window),
      session_(options, notice_, [] { Window::wake(); }),
      saving_(
          options.scene, [this] { return session_.sceneNow(); }, [this] { session_.setSaved(); },
          notice_),
      memory_(memory) {}

int WindowSession::run() {
  while (!window_.shouldClose() && !session_.isOver()) step();
  return session_.end("the window was closed");
}

void WindowSession::step() {
  window_.wait(session_.isMoving() ? kMoving : kIdle);
  const std::vector<WindowEvent> events = window_.takeEvents();
  if (session_.load()) {
    for (const Command& command : session_.step(events, window_.pictureArea())) carryOut(command);
    if (const DisplayImage* picture = session_.draw()) window_.setPicture(*picture);
  }
  redraw();
  tellTitle();
}

// How far the picture is, of which scene, and whether that has changes (*) that no file has.
void WindowSession::tellTitle() {
  std::string title = "ninefold";
  if (const Shown* shown = session_.board().shown())
    title += shown->frame.moving
                 ? ": moving"
                 : fmt::format(": {} frame{}", shown->frames, shown->frames == 1 ? "" : "s");
  title += " - " + std::filesystem::path(options_.scene).filename().string();
  if (session_.isLoaded() && !session_.isSaved()) title += "*";
  if (title != std::exchange(title_, title)) window_.setTitle(title);
}

void WindowSession::redraw() {
  window_.beginFrame(column_);
  if (!session_.isLoaded()) {
    drawProgress("reading " + options_.scene, 0.05);
  } else if (session_.board().shown() == nullptr) {
    double done = 0;
    const std::string state = session_.progress(done);
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
    PanelView view = session_.panelView();
    view.folded = memory_.folded;
    const PanelChanges changes = drawPanel(view);
    window_.cover(changes.area);
    memory_.folded = changes.folded;
    if (!changes.folded) column_ = changes.area.high.x + changes.area.low.x;
    session_.apply(changes);
    if (changes.saveScene) saving_.save();
  }
  saving_.draw(window_);
}

void WindowSession::carryOut(const Command& command) {
  switch (command.kind) {
    case Command::Kind::saveScene:
      return saving_.save();
    case Command::Kind::savePicture:
      return session_.board().save("png");
    case Command::Kind::togglePanel:
      panel_ = !panel_;
      return;
    case Command::Kind::toggleKeys:
      keys_ = !keys_;
      return;
    case Command::Kind::close:
      return window_.close();
    default:
      return;  // the session's
  }
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
