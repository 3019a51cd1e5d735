// web_offer.h: what viewers may see now, and the bytes that one of them gets of it.
//
// An update is one binary message of the WebSocket:
//
//   u32      bytes of the head, little-endian
//   head     JSON: what the session tells (web_session.cpp), and "you", "control", "asking",
//            "viewers"; with a body "body", its media type, and "file", its name if it is to be
//            saved
//   body     a picture or a file; empty: the picture is as it was
//
// Threads: an offer is constant once it is made, but for the files of its picture, which the
// server's thread makes.   Errors: Error if a picture cannot be encoded.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/image/tone_map.h"
#include "master/web/picture_pace.h"
#include "master/web/viewer_book.h"

namespace ninefold {

struct WebBody {
  std::string type;    // media type
  std::string saveAs;  // name of a file; empty: it is to be shown
  std::vector<uint8_t> bytes;
};

// A picture in the forms that viewers have asked for.
class WebPicture {
 public:
  WebPicture(DisplayImage codes, int64_t frames) : codes_(std::move(codes)), frames_(frames) {}
  int64_t frames() const { return frames_; }  // that it is the mean of; moving: 0
  const std::shared_ptr<const WebBody>& as(size_t form);

 private:
  DisplayImage codes_;
  int64_t frames_;
  std::array<std::shared_ptr<const WebBody>, kPictureForms.size()> bodies_;
};

// Means of shrink x shrink codes; what does not fill a block at the right and lower edge is left
// out.
DisplayImage shrunk(const DisplayImage& codes, int shrink);

struct WebOffer {
  std::shared_ptr<WebPicture> picture;  // null: none yet
  std::string state = "{}";             // a JSON object: what the session tells
  std::string metrics;
};

// `body` may be null.
std::string headOf(const std::string& state, const ViewerBook& book, ViewerId viewer,
                   const WebBody* body);

}  // namespace ninefold
