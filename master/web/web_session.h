// web_session.h: a session in browsers (--serve): what viewers say becomes events and changes of
// the session, as a window's would; what is drawn, and what there is to tell, is offered to them.
//
// Threads: the main thread.
// Errors: throws Error for what the user must know, as runHeadless does.
#pragma once

#include "master/session/session.h"
#include "master/web/web_server.h"

namespace ninefold {

class WebSession {
 public:
  WebSession(const Options& options, WebSetup setup);

  // Until a signal ends it; the exit status as of runHeadless.
  int run();
  uint16_t port() const { return server_.port(); }

 private:
  void step();
  void hear(const FromViewer& said);
  void see();
  void sendFiles();
  WebBody fileOf(said::Download::Kind kind);
  void offer();
  std::string state() const;
  std::string metrics() const;

  const std::string scene_;  // its name
  Notice notice_;
  WebServer server_;
  Session session_;
  WindowArea area_{{0, 0}, {1, 1}};  // of the picture, on the screen of who is in control
  std::vector<WindowEvent> events_;
  std::shared_ptr<WebPicture> picture_;
  bool isNew_ = false;  // it has not been offered
  Time offered_{};
  struct Wish {
    ViewerId viewer;
    said::Download::Kind kind;
  };
  std::vector<Wish> wishes_;  // files
};

// --serve.
int runWeb(const Options& options);

}  // namespace ninefold
