// needs.h: what a scene asks of the renderer. What is not needed is not set up, not sent and not
// timed.
//
// Roughness tells three kinds of reflection lobe, here and for all methods:
//   folded   so rough that it cannot be told from diffuse; part of D for the whole material, see
//            foldsIntoDiffuse
//   glossy   less rough, but rough enough for VPLs to stand on it, see kGlossyRoughness
//   the rest is the caustic photons' work
// Sheen is glossy, and what lies under a clear coat is the photons' work together with the coat.
// Threads: pure functions.
#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace ninefold {

// Perceptual roughness from which on the reflection lobe of an opaque surface is glossy: VPLs find
// the light that it sends on. Measured, see glossy_vpl.h.
inline constexpr float kGlossyRoughness = 0.4f;

struct Needs {
  bool reflection = false;      // some material keeps a reflection lobe
  bool transmission = false;    // some material transmits or blends
  bool roughSpecular = false;   // some S lobe is not smooth: lights are sampled at S vertices
  bool smoothSpecular = false;  // some S lobe is: only chance meets a light by it
  bool glossy = false;          // VPLs stand on some S lobes
  bool caustics = false;        // others focus light: photons
  bool textures = false;
  bool alphaMask = false;
  bool areaLights = false, punctualLights = false, environment = false;

  bool specular() const { return reflection || transmission; }
  uint8_t layerMask() const;  // bits of image/layers.h
};

// True if the material is a dielectric interface that lets light through. It has a D lobe only for
// the share that it does not transmit, and its reflection lobe is never folded.
bool transmits(const Material& material);

// True if the opaque reflection lobe of a material is folded into D: its smallest perceptual
// roughness over the texture is at least 0.6 for dielectrics (metallic < 0.5 everywhere), 0.85 for
// metals; or its specular factor is 0 and it is no metal at all.
bool foldsIntoDiffuse(const Scene& scene, const Material& material);

// True if light passes straight through the material between equal media: blended, or a thin wall.
bool letsPassStraight(const Scene& scene, const Material& material);

// True if the material has an S lobe that is neither folded nor glossy everywhere, or a coat.
// Passing straight on is not focusing.
bool focusesLight(const Scene& scene, const Material& material);

// `environment`: the radiance that is rendered with, instead of the scene's own.
Needs needsOf(const Scene& scene, Radiance environment);

// One line for each need: what is on or off, and why. First lines of the log.
std::vector<std::string> describe(const Needs& needs);

}  // namespace ninefold
