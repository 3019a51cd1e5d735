#include "master/options/preset.h"

namespace ninefold {

Settings settingsOf(Preset preset) {
  Settings s;
  if (preset == Preset::final) {
    s.directVpls = 16, s.indirectVpls = 72;
    s.photons = 10000;
  }
  if (preset == Preset::paper) {
    s.pathLength = 4;
    s.caustics = Caustics::direct;
    s.randomization = Randomization::exclusiveOr;
    s.bound = 300, s.vplRoulette = 0;
    s.compensate = s.jitter = false;
  }
  if (preset == Preset::segovia) {
    s.method = Method::bidirectional;
    s.partition = PartitionRule::equal;
    s.interleave = {1, 1};
    s.directVpls = 6, s.indirectVpls = 24;
    s.resampling = 5, s.cameraPoints = 50;
  }
  if (preset == Preset::dmitriev) {
    s.method = Method::selective;
    s.photonPool = 1152000, s.photonGroups = 288, s.pilotRatio = 16;
    s.elementRule = ElementRule::buckets;
  }
  if (preset == Preset::ren) {
    s.method = Method::intersectionField;
    s.fieldDirections = 76, s.fieldDistances = 127;
    s.fieldDirect = FieldDirect::field, s.fieldWeights = FieldWeights::alike;
  }
  return s;
}

}  // namespace ninefold
