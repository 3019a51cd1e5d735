// view.h: what a picture may show instead of beauty: one quantity of a frame as a colour.
//
//   albedo, normal, depth   of the first hit      objects   a colour for each thing
//   direct, indirect        light that came straight, or by at least one diffuse bounce
//   caustics                the photons' part of E in the diffuse layer
//   sets                    which light set a pixel met
//   error                   standard error of the mean so far, over the mean
//   clients                 who rendered what
//   photons                 of a method with a pool of them: what each lights by itself, within
//                           0.004 R of where it hit; of others: beauty
//   weights                 the share of its window that the discontinuity buffer averaged, in the
//                           diffuse layer; only the pixel itself where light is not filtered
//
// A view asks for just the planes that it needs, and for the settings that leave only its part of
// the light.
// Threads: pure functions.   Errors: none.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "common/image/film.h"
#include "common/image/patch_filter.h"
#include "common/scene/settings.h"

namespace ninefold {

enum class PictureView : uint8_t {
  beauty,
  albedo,
  normal,
  depth,
  direct,
  indirect,
  caustics,
  sets,
  error,
  clients,
  objects,
  weights,
  photons
};
inline constexpr std::array kViewNames{"beauty",   "albedo",   "normal", "depth", "direct",
                                       "indirect", "caustics", "sets",   "error", "clients",
                                       "objects",  "weights",  "photons"};

inline const char* nameOf(PictureView view) { return kViewNames[static_cast<size_t>(view)]; }
std::optional<PictureView> viewNamed(const std::string& name);

// The view of a number key: 1 .. 9, 0 are the first ten, Shift+1 .. those beyond. Nothing if there
// is none.
std::optional<PictureView> viewOfKey(int digit, bool shift);
std::string keyOf(PictureView view);  // "7", "Shift+1"

inline constexpr float kDepthShownWhite = 2;  // in radii of the scene

// Extra planes, and settings, that a task needs for it.
uint8_t planesOf(PictureView view);
Settings settingsFor(PictureView view, Settings settings);

// Whether it is light, which clients can filter; else it is made at the master of what they traced.
bool isLight(PictureView view);

// Whether it is painted over the light of each frame; error is made of the film.
inline bool isPainted(PictureView view) { return !isLight(view) && view != PictureView::error; }

// Where its colours are codes and not light, so that exposure must leave them alone.
bool isFalseColor(PictureView view);

// Replaces the tile's beauty, just composed by `filter`, by the view's colours. `depthScale` [m]:
// what is shown white. `owners`: by phase, the number of the client that rendered it; may be null.
void paint(PictureView view, const Patch& patch, const PatchFilter& filter, float neighbourWeight,
           uint32_t rotation, float depthScale, const uint32_t* owners, RgbImage& beauty);

// The film's error after `frames` frames over its mean, in place of the mean, within a tile.
void paintError(const Film& film, int64_t frames, const TaskRect& tile, RgbImage& mean);

// A colour for a number, far from its neighbours'.
Vec3 colorOf(uint32_t number);

}  // namespace ninefold
