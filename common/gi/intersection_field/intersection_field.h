// intersection_field.h: the method intersection field. Where a fixed set of lines meets the scene
// is worked out once; photons then go along lines, and no ray is traced for bounced light.
//
//   last turn before x          who brings it
//   none: straight from a lamp  direct VPLs, and compensation of their bound: L_e alone; or, of
//                               lamps that are surfaces, H V by the field (lamp_visibility.h)
//   D, or a glossy lobe         photons of the field, by mesh elements (elements/element_light.h)
//   any other S lobe            caustic photons (caustic_photons.h)
//
//   field            line_field.h: made by each client from the scene. An edit makes those parts
//                    anew that belong to what moved or changed its shape, in a gesture and at rest.
//   state            what the photons left, row by row (elements/photon_rows.h)
//   unit of a step   one row of kPhotonsOfRow photons, in the order of row_order.h
//   photon           leaves its lamp, mirrors and glass by a ray, matte surfaces by a line
//                    (line_walk.h)
//
// At rest each frame has photons of its own, by numbers with other digit shifts
// (sampling/halton.h). So frames are independent. The lines stay the same.
//
// Other ways than the paper's: light lies in mesh elements that share their corners, not in texture
// atlases; the way of a field to the clients is that each makes it; line_grid.h, local_field.h and
// node_lines.h name theirs.
//
// Source:  Ren, Hua, Chen and Bao, "Intersection Fields for Interactive Global Illumination", 2005.
// Proved:  tests/gi (all tests over the table of methods; intersection_field_test.cpp).
// Fails:   light that has bounced is blurred over an element, on its side of what stands there
//          (node_parts.h), or, in a gesture, of what stands still there (still_scene.h). What is
//          smaller than the lines lie apart is missed: its shadows, and gaps through which light
//          comes. By field-direct field, what stands on an element darkens the light straight from
//          lamps, too.
// Threads, owner, errors: as method.h says.
#pragma once

#include "common/gi/intersection_field/lamp_visibility.h"
#include "common/gi/intersection_field/line_walk.h"
#include "common/gi/intersection_field/row_order.h"
#include "common/gi/light_set/light_set.h"

namespace ninefold {

class IntersectionField final : public LayeredMethod {
 public:
  // `begun`: of the scene that a gesture began with, or null: lines stay as they are there.
  // `before`: of any earlier scene, or null: it saves work alone.
  // Errors: throws TooLarge if it would be larger than --max-field-memory.
  IntersectionField(const Transport& transport, const IntersectionField* begun,
                    const IntersectionField* before = nullptr);

  // `state` may be null: the empty state, without a photon.
  std::shared_ptr<const FrameLight> light(const FrameKey& frame, int set,
                                          std::span<const View> views,
                                          const MethodState* state) const override;
  std::unique_ptr<Scratch> makeScratch() const override;
  StepResult step(const StatePages& pages, const StepKey& step, uint32_t unit,
                  const View& view) const override;
  std::shared_ptr<const MethodState> digest(const StatePages& pages,
                                            const MethodState* before) const override;

  const LineField& field() const { return field_; }
  const SceneNodeLines& nodeLines() const { return lines_; }
  const LampVisibility* lamps() const { return lamps_.get(); }  // null: by VPLs
  size_t bytes() const;  // of all that --max-field-memory bounds

 protected:
  void query(const FrameLight& light, const ReceiverSamples& samples, int pathVertices,
             LayeredScratch& scratch, Receivers& receivers, std::vector<Irradiance>* caustic,
             RayCounts& rays) const override;

 private:
  // What may be used again: lines and their light, and elements. Null: nothing.
  struct Known {
    const IntersectionField *lines, *elements;
  };
  static Known knownOf(const IntersectionField* begun, const IntersectionField* before);
  IntersectionField(const Transport& transport, const IntersectionField* begun, const Known& known);
  PhotonRow shoot(uint32_t row, uint32_t randomization, uint32_t version, RayCounts& rays) const;

  const PhotonRows rows_;
  const std::shared_ptr<const SurfaceNumbers> surfaces_;
  const uint64_t stamp_;
  const float lampFlux_;  // of all lamps as they are now, largest component [W]
  const RowOrder order_;
  const StillScene still_;
  const std::shared_ptr<const SceneElements> elements_;
  const LineField field_;
  const SceneNodeLines lines_;
  const std::unique_ptr<const LampVisibility> lamps_;  // null: direct light is by VPLs
};

}  // namespace ninefold
