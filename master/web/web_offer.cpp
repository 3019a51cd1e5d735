#include "master/web/web_offer.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/image/encode.h"

namespace ninefold {

const std::shared_ptr<const WebBody>& WebPicture::as(size_t form) {
  std::shared_ptr<const WebBody>& body = bodies_.at(form);
  if (body) return body;
  const PictureForm how = kPictureForms.at(form);
  const bool isSmall = std::min(codes_.width, codes_.height) < how.shrink;
  const DisplayImage smaller =
      how.shrink > 1 && !isSmall ? shrunk(codes_, how.shrink) : DisplayImage();
  const DisplayImage& codes = smaller.empty() ? codes_ : smaller;
  WebBody made;
  made.type = how.quality == 0 ? "image/png" : "image/jpeg";
  made.bytes = how.quality == 0 ? encodePng(codes.width, codes.height, 3, codes.rgb)
                                : encodeJpeg(codes.width, codes.height, how.quality, codes.rgb);
  body = std::make_shared<const WebBody>(std::move(made));
  return body;
}

DisplayImage shrunk(const DisplayImage& codes, int shrink) {
  DisplayImage small;
  small.reshape(codes.width / shrink, codes.height / shrink);
  const auto row = 3 * static_cast<size_t>(codes.width);
  const auto step = static_cast<size_t>(shrink);
  const unsigned area = static_cast<unsigned>(shrink * shrink);
  size_t out = 0;
  for (size_t y = 0; y < static_cast<size_t>(small.height); ++y)
    for (size_t x = 0; x < static_cast<size_t>(small.width); ++x)
      for (size_t c = 0; c < 3; ++c) {
        unsigned sum = area / 2;  // rounds
        for (size_t v = 0; v < step; ++v)
          for (size_t u = 0; u < step; ++u)
            sum += codes.rgb[(y * step + v) * row + 3 * (x * step + u) + c];
        small.rgb[out++] = static_cast<uint8_t>(sum / area);
      }
  return small;
}

std::string headOf(const std::string& state, const ViewerBook& book, ViewerId viewer,
                   const WebBody* body) {
  nlohmann::json head = nlohmann::json::parse(state);
  head["you"] = viewer;
  head["control"] = book.inControl() ? nlohmann::json(*book.inControl()) : nlohmann::json();
  head["asking"] = book.asking();
  head["viewers"] = book.all().size();
  if (body != nullptr) head["body"] = body->type;
  if (body != nullptr && !body->saveAs.empty()) head["file"] = body->saveAs;
  return head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace ninefold
