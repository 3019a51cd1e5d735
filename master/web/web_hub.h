// web_hub.h: what the server decides, without sockets: who looks on, what each may say, and what
// each gets next. Messages and the time go in, updates and what the session is to know come out.
// Pure.
//
// Encoding is what costs. A picture at rest, from PicturePace::kCalm frames on, is taken from what
// is offered twice a second, and all viewers get the same ones, each encoded once in each form.
//
// Threads: plain value, one owner.
// Errors: join and hear throw Error in one line: the viewer's fault, its connection ends.
// Proved: tests/web/web_hub_test.cpp.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "master/web/picture_pace.h"
#include "master/web/web_offer.h"
#include "master/web/web_server.h"

namespace ninefold {

struct WebUpdate {
  std::string head;
  std::shared_ptr<const WebBody> body;  // null: none
};

class WebHub {
 public:
  static constexpr size_t kMostViewers = 16;
  static constexpr double kMostMessages = 480;                // a second, and at once twice as many
  static constexpr Duration kStateEvery = milliseconds(250);  // without a new picture
  static constexpr Duration kCalmly = milliseconds(500);
  static constexpr Duration kShownWithin = std::chrono::seconds(30);

  ViewerId join(Time now);
  void leave(ViewerId id);
  void hear(ViewerId id, const ViewerMessage& message, Time now);
  std::vector<FromViewer> takeHeard() { return std::exchange(heard_, {}); }

  void offer(WebOffer offer) { offer_ = std::move(offer); }
  const WebOffer& offered() const { return offer_; }
  void send(ViewerId id, std::shared_ptr<const WebBody> file);  // nothing if it has left

  // The update that a viewer gets now, if it is ready for one and there is something new.
  std::optional<WebUpdate> next(ViewerId id, Time now);
  // Its update is on the line: from now on it is waited for.
  void written(ViewerId id, Time now);
  // It has not shown its last update in time.
  bool isLate(ViewerId id, Time now) const;
  size_t viewers() const { return seats_.size(); }

 private:
  struct Seat {
    PicturePace pace;
    Vec2 size{1};
    double allowance = 0;  // of messages
    Time allowedAt{};
    std::optional<Time> waitsSince;  // for its update to be shown
    bool isPictureUnderWay = false;
    std::shared_ptr<WebPicture> picture;  // the latest that was sent
    std::string told;                     // the latest head, without what a body adds
    Time toldAt = Time::min();
    bool wantsFile = false;
    std::shared_ptr<const WebBody> file;
  };
  const std::shared_ptr<WebPicture>& latest(Time now);
  void pay(Seat& seat, Time now);
  void acknowledge(Seat& seat, Time now);
  void download(ViewerId id, Seat& seat, const said::Download& wish);
  void noteHand(std::optional<ViewerId> before);
  std::optional<WebUpdate> update(ViewerId id, Seat& seat, std::shared_ptr<const WebBody> body,
                                  Time now);

  ViewerId nextId_ = 1;
  std::map<ViewerId, Seat> seats_;
  ViewerBook book_;
  WebOffer offer_;
  std::shared_ptr<WebPicture> latest_;  // what viewers get; null: none yet
  Time latestAt_{};                     // when it was taken from the offer
  std::vector<FromViewer> heard_;
};

}  // namespace ninefold
