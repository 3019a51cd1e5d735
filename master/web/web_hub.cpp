#include "master/web/web_hub.h"

#include <algorithm>

#include "common/base/error.h"

namespace ninefold {
namespace {

said::Event at(said::Event event, Time now) {
  event.event.time = now;
  return event;
}

}  // namespace

ViewerId WebHub::join(Time now) {
  if (seats_.size() >= kMostViewers)
    fail("{} viewers look on already; try again when one has left", kMostViewers);
  const ViewerId id = nextId_++;
  Seat& seat = seats_[id];
  seat.allowance = 2 * kMostMessages;
  seat.allowedAt = now;
  const auto before = book_.inControl();
  book_.join(id);
  noteHand(before);
  return id;
}

void WebHub::leave(ViewerId id) {
  const auto before = book_.inControl();
  seats_.erase(id);
  book_.leave(id);
  noteHand(before);
}

// Who takes over begins with nothing held, and with a picture of its own size.
void WebHub::noteHand(std::optional<ViewerId> before) {
  const auto now = book_.inControl();
  if (now == before) return;
  heard_.push_back({now.value_or(0), NewHand{}});
  if (now) heard_.push_back({*now, said::Size{seats_.at(*now).size}});
}

void WebHub::pay(Seat& seat, Time now) {
  const double past = seconds(now - std::exchange(seat.allowedAt, now));
  seat.allowance = std::min(2 * kMostMessages, seat.allowance + kMostMessages * past) - 1;
  if (seat.allowance < 0) fail("more than {:.0f} messages a second", kMostMessages);
}

void WebHub::hear(ViewerId id, const ViewerMessage& message, Time now) {
  Seat& seat = seats_.at(id);
  pay(seat, now);
  const auto inControl = [&](const auto& what) {
    if (book_.isInControl(id)) heard_.push_back({id, what});
  };
  const auto before = book_.inControl();
  std::visit(
      [&](const auto& what) {
        using What = std::decay_t<decltype(what)>;
        if constexpr (std::is_same_v<What, said::Hello>)
          fail("a second hello");
        else if constexpr (std::is_same_v<What, said::Shown>)
          acknowledge(seat, now);
        else if constexpr (std::is_same_v<What, said::Ask>)
          book_.ask(id);
        else if constexpr (std::is_same_v<What, said::Give>)
          book_.give(id);
        else if constexpr (std::is_same_v<What, said::Download>)
          download(id, seat, what);
        else if constexpr (std::is_same_v<What, said::Event>)
          inControl(at(what, now));
        else
          inControl(what);
      },
      message);
  if (const auto* size = std::get_if<said::Size>(&message)) seat.size = size->size;
  noteHand(before);
}

void WebHub::acknowledge(Seat& seat, Time now) {
  if (!seat.waitsSince) fail("shown, and no update was under way");
  seat.waitsSince.reset();
  if (seat.isPictureUnderWay) seat.pace.shown(now);
}

// One file at a time; who asks again meanwhile gets that one.
void WebHub::download(ViewerId id, Seat& seat, const said::Download& wish) {
  if (!std::exchange(seat.wantsFile, true)) heard_.push_back({id, wish});
}

void WebHub::send(ViewerId id, std::shared_ptr<const WebBody> file) {
  const auto seat = seats_.find(id);
  if (seat != seats_.end()) seat->second.file = std::move(file);
}

// Fewer frames: another film. As many: another look.
const std::shared_ptr<WebPicture>& WebHub::latest(Time now) {
  const auto& newest = offer_.picture;
  if (newest == nullptr || newest == latest_) return latest_;
  const bool isHardlyBetter = latest_ != nullptr && latest_->frames() >= PicturePace::kCalm &&
                              newest->frames() > latest_->frames();
  if (isHardlyBetter && now - latestAt_ < kCalmly) return latest_;
  latest_ = newest, latestAt_ = now;
  return latest_;
}

std::optional<WebUpdate> WebHub::next(ViewerId id, Time now) {
  Seat& seat = seats_.at(id);
  if (seat.waitsSince) return std::nullopt;
  seat.isPictureUnderWay = false;
  if (seat.file != nullptr) {
    seat.wantsFile = false;
    return update(id, seat, std::exchange(seat.file, {}), now);
  }
  const auto& picture = latest(now);
  if (picture != nullptr && picture != seat.picture) {
    seat.picture = picture;
    seat.isPictureUnderWay = true;
    auto body = picture->as(seat.pace.form(picture->frames()));
    seat.pace.sent(now);
    return update(id, seat, std::move(body), now);
  }
  if (seat.toldAt != Time::min() && now - seat.toldAt < kStateEvery) return std::nullopt;
  return update(id, seat, nullptr, now);
}

std::optional<WebUpdate> WebHub::update(ViewerId id, Seat& seat,
                                        std::shared_ptr<const WebBody> body, Time now) {
  std::string told = headOf(offer_.state, book_, id, nullptr);
  if (body == nullptr && told == seat.told) return std::nullopt;
  seat.told = std::move(told);
  seat.toldAt = now;
  seat.waitsSince = now;
  std::string head = body == nullptr ? seat.told : headOf(offer_.state, book_, id, body.get());
  return WebUpdate{std::move(head), std::move(body)};
}

void WebHub::written(ViewerId id, Time now) {
  Seat& seat = seats_.at(id);
  if (seat.waitsSince) seat.waitsSince = now;
}

bool WebHub::isLate(ViewerId id, Time now) const {
  const Seat& seat = seats_.at(id);
  return seat.waitsSince && now - *seat.waitsSince > kShownWithin;
}

}  // namespace ninefold
