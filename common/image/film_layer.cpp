#include "common/image/film_layer.h"

#include "common/base/prefetch.h"

namespace ninefold {
namespace {

// Adds values to running means, of which they are `share` from now on.
template <typename T>
void addValues(const float* values, size_t n, T share, T* mean) {
#pragma GCC ivdep
  for (size_t i = 0; i < n; ++i) mean[i] += (static_cast<T>(values[i]) - mean[i]) * share;
}

}  // namespace

template <typename T>
FilmLayer<T>::FilmLayer(int width, int height, bool keepsLuminance)
    : pixels_(pixelCount(width, height)) {
  if (keepsLuminance) luminance_.resize(pixels_);
  clear();
}

template <typename T>
void FilmLayer<T>::clear() {
  for (auto* mean : {&r_, &g_, &b_}) mean->assign(pixels_, 0);
  if (!luminance_.empty()) luminance_.resize(pixels_);
}

template <typename T>
void FilmLayer<T>::add(size_t first, const FilmRow& row, int64_t frame) {
  const T share = T(1) / static_cast<T>(frame + 1);
  const size_t n = row.luminance.size();
  addValues(row.r, n, share, &r_[first]);
  addValues(row.g, n, share, &g_[first]);
  addValues(row.b, n, share, &b_[first]);
  if (!luminance_.empty()) luminance_.add(row.luminance, first, frame);
}

template <typename T>
void FilmLayer<T>::prefetch(size_t first, size_t count) const {
  for (const auto* mean : {&r_, &g_, &b_})
    ninefold::prefetch<Soon::isWritten>(mean->data() + first, count * sizeof(T));
}

template <typename T>
void FilmLayer<T>::write(const TaskRect& tile, RgbImage& out) const {
  for (int y = tile.j0; y < tile.j0 + tile.height; ++y) {
    const size_t begin = out.at(tile.i0, y), end = begin + static_cast<size_t>(tile.width);
    for (size_t i = begin; i < end; ++i) out.pixels.r[i] = static_cast<float>(r_[i]);
    for (size_t i = begin; i < end; ++i) out.pixels.g[i] = static_cast<float>(g_[i]);
    for (size_t i = begin; i < end; ++i) out.pixels.b[i] = static_cast<float>(b_[i]);
  }
}

template <typename T>
void FilmLayer<T>::addTo(const TaskRect& tile, const std::vector<float>& share,
                         RgbImage& out) const {
  for (int y = tile.j0; y < tile.j0 + tile.height; ++y) {
    const size_t begin = out.at(tile.i0, y), end = begin + static_cast<size_t>(tile.width);
    for (size_t i = begin; i < end; ++i) out.pixels.r[i] += share[i] * static_cast<float>(r_[i]);
    for (size_t i = begin; i < end; ++i) out.pixels.g[i] += share[i] * static_cast<float>(g_[i]);
    for (size_t i = begin; i < end; ++i) out.pixels.b[i] += share[i] * static_cast<float>(b_[i]);
  }
}

template class FilmLayer<float>;
template class FilmLayer<double>;

}  // namespace ninefold
