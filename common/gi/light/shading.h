// shading.h: what light meets at a surface point: materials and textures turned into a Bsdf.
//
// Opaque        f0  = mix(((n-1)/(n+1))^2 specular, baseColor, metallic)
//               f90 = mix(specular factor, 1, metallic)
//               D   = baseColor (1-metallic) (1 - mean reflection of the dielectric part)
//               The mean albedo, not the directional one, couples D to the lobe: D's weight stays
//               free of directions.
// Transmitting  KHR_materials_transmission T: exact Fresnel; (1-F) T baseColor goes through, D
//               keeps the share 1-T.
// Folded        A lobe for which foldsIntoDiffuse holds adds its mean reflection to D and is gone.
// Layers        Sheen and coat (bsdf/layers.h) over opaque surfaces; D loses their mean albedos.
// Blended       Every part times the opacity; the rest passes straight on.
// Attenuation   exp(-sigma t) inside solids, sigma = -ln(colour)/attenuationDistance [1/m]
// Vertices      Their colours multiply baseColor and the opacity.
//
// Source:  glTF 2.0, appendix B, and the KHR_materials extensions.   Owner: refers to the Scene.
// Threads: const, reentrant.   Errors: none for valid scenes.
#pragma once

#include <array>
#include <vector>

#include "common/bsdf/bsdf.h"
#include "common/gi/light/media.h"
#include "common/math/basis.h"
#include "common/scene/needs.h"
#include "common/scene/scene.h"
#include "common/tracing/surface.h"

namespace ninefold {

// Whether w is in front of n. At n's horizon it is not: a lobe about n would be as good as none.
inline bool facesNormal(Vec3 n, Vec3 w) { return glm::dot(n, w) > 1e-4f; }

// Whether VPLs stand on the surface's reflection lobe.
inline bool isGlossy(const Bsdf& bsdf) {
  const bool isRough = bsdf.alpha >= kGlossyRoughness * kGlossyRoughness;
  return bsdf.reflects && !bsdf.dielectric && bsdf.coat == 0 && (isRough || isBlack(bsdf.f90));
}

// A surface point seen from direction wo; normals are turned to wo's side.
struct ShadingPoint {
  SurfacePoint surface;
  Vec3 wo{0};                  // unit, towards where the path came from
  Vec3 ng{0};                  // geometric normal on wo's side
  Vec3 ns{0};                  // shading normal on ng's side, of D: depends on wo's side alone
  Basis frame{Vec3(0, 0, 1)};  // of the eye's S lobes: about ns, or about ng if wo is behind ns
  Bsdf bsdf;
  bool front = true;  // wo is on the front side of the surface

  Vec3 localWo() const { return frame.toLocal(wo); }
};

// Mean reflection of the opaque lobe, linear in f0 for each roughness. A table: every hit asks.
class MeanReflection {
 public:
  MeanReflection();
  Reflectance operator()(Vec3 f0, Vec3 f90, float alpha) const;

 private:
  static constexpr int kSteps = 64;  // over sqrt(alpha), i.e. perceptual roughness
  struct Ends {
    float black, white;  // for f0 = 0 and f0 = 1
  };
  std::array<Ends, kSteps + 1> ends_;
};

class Shader {
 public:
  explicit Shader(const Scene& scene);

  // wo: unit, not in the surface's plane (dot(wo, geometricNormal) != 0). media: on wo's side.
  ShadingPoint shade(const SurfacePoint& surface, Vec3 wo, const MediumStack& media) const;

  // Share of radiance left after `distance` [m] (may be infinite) in a solid; 1 in air.
  Vec3 transmittance(int material, float distance) const;
  // ... inside the medium of a ray that ended on this point.
  Vec3 attenuation(const ShadingPoint& end, const MediumStack& media, float distance) const {
    return transmittance(before(end, media), distance);
  }
  // The medium on wo's side if it absorbs light, else kAir.
  int absorber(const ShadingPoint& point, const MediumStack& media) const;
  // The medium on wo's side.
  int before(const ShadingPoint& point, const MediumStack& media) const;

  // The path enters a solid of this material.
  void enter(MediumStack& media, int material) const;

  // The media after passing through the surface away from wo, and through all in contact with it.
  MediumStack pass(const ShadingPoint& point, MediumStack media) const;

  // Calls visit(material, enters) for each solid that a path through `surface` crosses: first those
  // that it leaves, then those that it enters, as between solids in contact there is no air.
  // fromFront: the path comes from the front of the surface.
  template <typename Visit>
  void forEachCrossed(const SurfacePoint& surface, bool fromFront, Visit&& visit) const {
    for (const bool enters : {false, true}) {
      if (isSolid(surface.material) && fromFront == enters) visit(surface.material, enters);
      for (int i = 0; i < surface.contactCount; ++i) {
        const SolidContact& contact = surface.contacts[static_cast<size_t>(i)];
        if ((contact.sameSide == fromFront) == enters) visit(contact.material, enters);
      }
    }
  }

  // True if `point` leaves a solid that the path never entered: it started inside.
  bool neverEntered(const ShadingPoint& point, const MediumStack& media) const;

  // n^2 of the innermost medium. Radiance is basic radiance L/n^2; particles carry flux [W], n^2
  // times what basic radiance says at a D vertex or an emitter.
  float squaredIndex(const MediumStack& media) const;

  // True if the material has an S lobe that is not glossy: photons aim at it.
  bool focuses(int material) const { return materials_[static_cast<size_t>(material)].focuses; }

  // True if light may pass straight through the surface, between equal media.
  bool passesStraight(const SurfacePoint& surface) const {
    return mayPassStraight(surface.material) && surface.contactCount == 0;
  }
  bool mayPassStraight(int material) const {
    return materials_[static_cast<size_t>(material)].passes;
  }

  // True if it refracts, and light goes on inside.
  bool isSolid(int material) const;

  // False if the material has no D lobe anywhere: clear glass, metal that keeps its S lobe.
  bool mayBeDiffuse(int material) const {
    return materials_[static_cast<size_t>(material)].diffuse;
  }

 private:
  struct FresnelEnds {
    Vec3 f0{0}, f90{0};  // at normal and grazing incidence
  };
  // Of a material, worked out once: every hit asks.
  struct Prepared {
    bool folds = false;      // opaque reflection lobe goes into D
    bool layered = false;    // under sheen or a coat
    bool transmits = false;  // dielectric interface
    bool focuses = false;    // has an S lobe that is the photons' work
    bool passes = false;     // may let light pass straight on
    bool diffuse = false;    // may have a D lobe
    int rank = 0;            // among overlapping solids: solid_ranks.h
    Vec3 sigma{0};           // attenuation inside [1/m]
    float meanFresnel = 0;   // of a transmitting material's interface
    bool fixedEnds = false;  // no texture changes `ends`
    FresnelEnds ends;        // of the dielectric part
    bool fixedMean = false;  // no texture changes `mean`
    Reflectance mean{0};     // reflection of the dielectric part
  };
  float indexOf(int material) const;
  Vec3 shadingNormal(const SurfacePoint& surface, Vec3 ng) const;
  void fillOpaque(Bsdf& bsdf, const Material& material, const Prepared& prepared, Vec3 base,
                  float metallic, float alpha, const SurfacePoint& s) const;
  void fillTransmitting(Bsdf& bsdf, const Material& material, const Prepared& prepared, Vec3 base,
                        float metallic, const SurfacePoint& s) const;
  // The layers over what fillOpaque filled in.
  void addLayers(Bsdf& bsdf, const Material& material, bool folds, const SurfacePoint& s) const;
  FresnelEnds dielectricEnds(const Material& material, const SurfacePoint& s) const;
  // Mean reflection of the dielectric part.
  Reflectance coatReflection(const FresnelEnds& ends, float alpha) const;

  const Scene* scene_;
  std::vector<Prepared> materials_;
  MeanReflection meanReflection_;
};

// Share of light that passes straight on towards p.wo, where passesStraight(p.surface).
inline Reflectance straightPass(const ShadingPoint& p) {
  return straightPass(p.bsdf, p.localWo().z);
}

// The factor |w.n| / |w.ng| on a particle's flux, for interpolated normals, on arrival from unit
// direction w (away from the surface); 0 where n and ng see w on different sides. n is ns for D,
// the frame's normal for S. Veach 1997, 5.3.
inline float shadingFactor(const ShadingPoint& p, Vec3 n, Vec3 w) {
  const float g = glm::dot(w, p.ng), s = glm::dot(w, n);
  return g * s <= 0 ? 0.0f : s / g;
}

}  // namespace ninefold
