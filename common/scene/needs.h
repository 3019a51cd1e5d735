// needs.h: what a scene asks of the renderer. What is not needed is not set up, not sent and not
// timed.
//
// The folding rule, written down once: a reflection lobe so rough that it cannot be told from
// diffuse is folded into D for the whole material, see foldsIntoDiffuse.
// Threads: pure functions.
#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "common/scene/settings.h"

namespace ninefold {

struct Needs {
  bool reflection = false;      // some material keeps a reflection lobe
  bool transmission = false;    // some material transmits or blends
  bool roughSpecular = false;   // some S lobe is not smooth: lights are sampled at S vertices
  bool smoothSpecular = false;  // some S lobe is: only chance meets a light by it
  bool textures = false;
  bool alphaMask = false;
  bool areaLights = false, punctualLights = false, environment = false;

  bool specular() const { return reflection || transmission; }
  uint8_t layerMask() const;  // bits of image/layers.h
};

// True if the material is a dielectric interface that lets light through: no D but for the share
// that it does not transmit, and a reflection lobe that is never folded.
bool transmits(const Material& material);

// True if the opaque reflection lobe of a material is folded into D: its smallest perceptual
// roughness over the texture is at least 0.6 for dielectrics (metallic < 0.5 everywhere), 0.85 for
// metals; or its specular factor is 0 and it is no metal at all. Looks at all texels: ask once per
// material.
bool foldsIntoDiffuse(const Scene& scene, const Material& material);

// The layers that a task of this method carries; master and clients must agree on it.
inline uint8_t layerMaskOf(const Needs& needs, Method method) {
  return method == Method::pathTrace ? uint8_t{1} : needs.layerMask();
}

// Whether all of a method's light is radiance U: then nothing of it is filtered.
inline bool isUnfiltered(Method method) { return method == Method::pathTrace; }

Needs needsOf(const Scene& scene, Radiance environment);

// One line for each need: what is on or off, and why. First lines of the log.
std::vector<std::string> describe(const Needs& needs);

// What these settings leave out of the picture, one line for each: warnings of the log.
std::vector<std::string> leftOut(const Needs& needs, const Settings& settings);

}  // namespace ninefold
