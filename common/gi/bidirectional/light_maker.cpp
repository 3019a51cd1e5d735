#include "common/gi/bidirectional/light_maker.h"

namespace ninefold {
namespace {

// Random numbers of receivers are addressed by layer. Those of set k at reverse places come after
// the layers of pictures: first for E(y), then for its guesses.
constexpr uint32_t kFirstUse = kLayers;
// So many of the raw VPLs, on average, are asked for a guess of E(y).
constexpr float kGuessingVpls = 20;

Place placeOf(const Vpl& vpl) { return {vpl.position, vpl.normal, vpl.error}; }

// A VPL at y that stands for `area` [m^2], with a power for E(y) = 1 W/m^2.
Vpl vplAt(const Transport& t, const ReversePlace& y, float area) {
  Vpl vpl;
  vpl.position = y.place.position, vpl.normal = y.place.normal, vpl.error = y.place.error;
  vpl.bound = t.bound, vpl.diffuseCount = 1, vpl.reverse = true;
  vpl.power = kInvPi * area * y.rho;
  return vpl;
}

// N'. Without direct VPLs there are those that light what the compensation meets.
int keptVpls(const Settings& s) {
  return (s.directVpls > 0 ? s.directVpls : Settings{}.directVpls) + s.indirectVpls;
}

LightSet standardCandidates(const Transport& t, const FrameKey& frame, int k, int times,
                            int pathsLog2) {
  LightSet candidates;
  addStandardVpls(t, frame, k, times, pathsLog2, candidates);
  return candidates;
}

// What lights reverse places, and the photons that E(y) needs whatever the picture shows; their
// lamps are chosen by power, as those of the `method`. Its light paths are four times as many as
// the candidates' paths: all reverse places of a set share them. They cost a fifth of the set's
// rays, and halve the squared error where light is rarely found.
LightSet rawSet(const Transport& t, const Transport& method, const FrameKey& frame, int k,
                int times, int pathsLog2) {
  LightSet raw;
  const Settings& s = t.settings;
  addStandardVpls(t, frame, k, times, pathsLog2 < 0 ? -1 : pathsLog2 + 2, raw);
  const int photons = s.photons > 0 ? s.photons : Settings{}.photons;
  raw.photons = causticPhotons(method, frame, k, raw.vpls, Caustics::all, photons, raw.rays);
  return raw;
}

// Direct candidates for each direct VPL of the settings.
int timesOf(const Settings& s, const Batch& batch) {
  return std::max(batch.partOf(s.resampling), 1);
}

int reverseRays(const Settings& s, const Batch& batch) {
  return batch.partOf(s.resampling * s.indirectVpls);
}

}  // namespace

LightMaker::LightMaker(const Transport& method, const ViewChoice& choice, const Batch& batch,
                       const FrameKey& frame, int set, std::span<const View> views)
    : method_(method),
      t_(choice.transport != nullptr ? *choice.transport : method),
      batch_(batch),
      frame_(batch.keyOf(frame)),
      k_(set),
      shot_(t_.allows(2) ? reverseRays(t_.settings, batch) : 0),
      samples_(t_.settings.seed, frame_.randomization, kFirstUse + static_cast<uint32_t>(set)),
      guesses_(t_.settings.seed, frame_.randomization,
               kFirstUse + kMostSets + static_cast<uint32_t>(set)),
      candidates_(standardCandidates(t_, frame_, set, timesOf(t_.settings, batch),
                                     batch.pathsLog2(choice.pathsLog2))),
      raw_(t_, rawSet(t_, method, frame_, set, timesOf(t_.settings, batch),
                      batch.pathsLog2(choice.pathsLog2))),
      camera_(cameraPoints(t_, views, frame_, set, t_.settings.cameraPoints, rays_)),
      partition_{
          t_, camera_.points, *choice.standard,
          choice.pathsLog2 < 0 ? 0 : static_cast<double>(1u << batch.pathsLog2(choice.pathsLog2)),
          static_cast<double>(shot_)},
      estimated_(
          partition_.isEqual() && shot_ > 0
              ? std::optional<EstimatedDensity>(std::in_place, t_, views, frame_, set, shot_, rays_)
              : std::nullopt),
      places_(reversePlaces(t_, estimated_ ? estimated_->origins() : camera_.points, frame_, set,
                            shot_, rays_)) {}

float LightMaker::density(const ReversePlace& y) {
  return estimated_ ? estimated_->at(y, rays_)
                    : reverseDensity(t_, camera_.points, y.place, y.drawnFrom, rays_);
}

float LightMaker::guessDensity(const ReversePlace& y, uint32_t reached) {
  return estimated_ ? estimated_->guess(y, rays_)
                    : guessReverseDensity(camera_, y.place, y.drawnFrom, reached);
}

Worth LightMaker::worths() {
  const LightSet& raw = raw_.set();
  Worth worth(t_, camera_);
  for (const Vpl& vpl : candidates_.vpls) {
    worth.add(candidates_, vpl, scratch_.vplGather, rays_);
    if (vpl.diffuseCount > 0 && vpl.glossy < 0 && shot_ > 0)
      worth.scale(partition_.standardShare(
          placeOf(vpl), guessReverseDensity(camera_, placeOf(vpl), kNone, worth.reached())));
  }
  Receivers y;
  for (const ReversePlace& place : places_) y.add(place.receiver);
  y.pad();
  const float guessing = std::max(static_cast<float>(raw.vpls.size()) / kGuessingVpls, 1.0f);
  gatherVpls(t_, raw, guesses_, kReverseLevel, guessing, scratch_.vplGather, y, rays_.shadow);
  for (const PhotonGrid& grid : raw.photons) gatherPhotons(t_, grid, kReverseLevel, y, nullptr);
  for (size_t j = 0; j < places_.size(); ++j) {
    const ReversePlace& p = places_[j];
    Vpl vpl = vplAt(t_, p, 1);
    vpl.power *= y.irradiance(j);
    worth.add({}, vpl, scratch_.vplGather, rays_);
    worth.scale(partition_.reverseArea(p.place, guessDensity(p, worth.reached())));
  }
  return worth;
}

std::vector<Vec3> LightMaker::positions() const {
  std::vector<Vec3> all;
  for (const Vpl& vpl : candidates_.vpls) all.push_back(vpl.position);
  for (const ReversePlace& y : places_) all.push_back(y.place.position);
  return all;
}

void LightMaker::keepStandard(const Vpl& candidate, float gain, float seen, LightSet& out) {
  Vpl vpl = candidate;
  vpl.power *= gain, vpl.seen = seen;
  if (vpl.diffuseCount > 0 && shot_ > 0) {
    const Place y = placeOf(vpl);
    vpl.power *= partition_.standardShare(y, reverseDensity(t_, camera_.points, y, kNone, rays_));
  }
  if (vpl.glossy >= 0) {
    out.glossy.push_back(candidates_.glossy[static_cast<size_t>(vpl.glossy)]);
    out.glossy.back().flux *= gain;
    vpl.glossy = static_cast<int>(out.glossy.size()) - 1;
  }
  if (vpl.glossy >= 0 || !isBlack(vpl.power)) out.vpls.push_back(vpl);
}

void LightMaker::keepReverse(const std::vector<Kept>& kept, const Worth& worth, LightSet& out) {
  const size_t firstReverse = candidates_.vpls.size();
  std::vector<Vpl> vpls;
  Receivers y;
  for (const Kept& each : kept) {
    if (each.index < firstReverse) continue;
    const ReversePlace& p = places_[each.index - firstReverse];
    vpls.push_back(vplAt(t_, p, each.gain * partition_.reverseArea(p.place, density(p))));
    vpls.back().seen = worth.seen(each.index);
    y.add(p.receiver);
  }
  if (vpls.empty()) return;
  for (int c = 1; c <= raw_.sums(); ++c) {
    y.clearIrradiance();
    raw_.gather(c, samples_, scratch_, y, rays_);
    for (size_t i = 0; i < vpls.size(); ++i) {
      Vpl vpl = vpls[i];
      vpl.power *= y.irradiance(i), vpl.diffuseCount = c;
      if (!isBlack(vpl.power)) out.vpls.push_back(vpl);
    }
  }
}

void LightMaker::make(LightSet& out) {
  const LightSet& raw = raw_.set();
  const Settings& s = t_.settings;
  const uint64_t key = hashWords(s.seed, static_cast<uint64_t>(SampleUse::resampling),
                                 frame_.randomization, static_cast<uint64_t>(k_));
  const Worth worth = worths();
  std::vector<Kept> kept =
      resample(worth.values(), positions(), batch_.partOf(keptVpls(s)), t_.radius, key);
  for (Kept& each : kept) each.gain /= static_cast<float>(batch_.count());
  for (const Kept& each : kept)
    if (each.index < candidates_.vpls.size())
      keepStandard(candidates_.vpls[each.index], each.gain, worth.seen(each.index), out);
  keepReverse(kept, worth, out);
  if (batch_.index == 0)
    out.photons = s.caustics == Caustics::all && s.photons > 0
                      ? raw.photons
                      : causticPhotons(method_, frame_, k_, raw.vpls, s.caustics, s.photons, rays_);
  out.rays += rays_, out.rays += candidates_.rays, out.rays += raw.rays;
}

}  // namespace ninefold
