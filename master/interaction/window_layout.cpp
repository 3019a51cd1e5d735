#include "master/interaction/window_layout.h"

#include <algorithm>

namespace ninefold {

WindowSize firstSize(int pictureWidth, int pictureHeight, const WindowMemory& memory,
                     const ScreenSpace& screen) {
  const bool isKnown = screen.width > 0 && screen.height > 0;
  const auto within = [&](WindowSize size) -> WindowSize {
    if (!isKnown) return size;
    return {std::min(size.width, screen.width), std::min(size.height, screen.height)};
  };
  if (memory.width > 0 && memory.height > 0) return within({memory.width, memory.height});
  const auto width = static_cast<float>(pictureWidth), height = static_cast<float>(pictureHeight);
  const float column = panelColumn(screen.scale);
  const float least = screen.scale * static_cast<float>(kLeastHeight);
  float zoom = std::max(screen.scale, least / height);
  if (isKnown)
    zoom = std::min({zoom, std::max(1.0f, static_cast<float>(screen.width) - column) / width,
                     static_cast<float>(screen.height) / height});
  return within(
      {static_cast<int>(column + zoom * width), static_cast<int>(std::max(least, zoom * height))});
}

WindowArea areaOfPicture(WindowSize windowSize, float column, WindowSize pictureSize) {
  const Vec2 window(static_cast<float>(windowSize.width), static_cast<float>(windowSize.height));
  const Vec2 picture(static_cast<float>(pictureSize.width), static_cast<float>(pictureSize.height));
  if (pictureSize.width == 0 || window.x <= 0 || window.y <= 0) return {Vec2(0), window};
  const Vec2 corner(2 * column <= window.x ? column : 0, 0);
  const Vec2 room = window - corner;
  const Vec2 size = std::min(room.x / picture.x, room.y / picture.y) * picture;
  return {corner + 0.5f * (room - size), corner + 0.5f * (room + size)};
}

}  // namespace ninefold
