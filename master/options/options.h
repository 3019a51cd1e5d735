// options.h: the command line of ninefold-master. Flags, then environment (NINEFOLD_*), then the
// preset's defaults.
//
//   options_flags   which flags there are, the text of --help, raw values from flags and variables
//   settings_flags  those of them that are settings
//   options         what they mean: checked values, presets, what this release does not have
//   makeSettings    with a scene: the settings of a job
//
// Errors: UsageError with one line that names the flag; main ends with status 2.
// Threads: pure functions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/base/command_line.h"
#include "common/image/surface_test.h"
#include "common/scene/methods.h"
#include "common/scene/reader.h"
#include "common/scene/settings.h"
#include "master/assembly/view.h"
#include "master/options/preset.h"
#include "master/options/script.h"
#include "master/options/stop_rule.h"
#include "proto/messages.h"

namespace ninefold {

struct Options {
  bool help = false;                  // print helpText() and end; nothing else counts
  bool version = false;               // print the release and end; nothing else counts
  std::optional<std::string> newKey;  // make this key file and end; nothing else counts

  std::string scene;    // file
  ReadOptions reading;  // of it
  std::string camera;   // see scene/camera_choice.h; empty: the scene's first
  Preset preset = Preset::interactive;
  Settings settings;                    // camera and environment are the scene's: makeSettings
  std::optional<Radiance> environment;  // nothing: the scene's
  SurfaceTest surfaceTest = SurfaceTest::surface;
  bool filterAtClients = false;
  int wireLevel = Delivery::kAdaptive;
  bool converging = true;  // radius and neighbours' share shrink as the film knows better

  int localClients = 1;  // 0 = only remote ones
  int clientThreads = 1;
  std::string listen = "127.0.0.1:0";  // ADDR:PORT
  std::optional<std::string> keyFile;
  std::optional<std::string> addressFile;  // gets the addresses at which it listens
  bool announce = false;                   // on the LAN, by DNS-SD
  std::optional<std::string> hosts;        // file: where ssh starts clients
  int waitClients = 1;
  double verify = 0;         // fraction of results that a second client does again
  std::string isa = "auto";  // for local clients: auto, avx2, avx512
  double patience = 120;     // unless somebody looks on, with clients that are all stuck [s]

  bool window = false;
  std::optional<std::string> script;      // file
  std::optional<AnimationRange> animate;  // then stop.frames is for each picture
  double shutter = 0;  // of each, open: fraction of the time to the next one, 0 to 1
  std::optional<std::string> photonScene;  // file; nothing: photons meet the scene itself
  PictureView view = PictureView::beauty;
  double frameTime = 100;          // target while something moves [ms]
  std::optional<double> stepTime;  // of a step of a state, then [ms]; nothing: by frameTime

  StopRule stop;                        // 64 frames if no flag says otherwise
  std::optional<int64_t> framesAtRest;  // of a picture that is watched; nothing: without end

  std::optional<std::string> output;      // .exr, .png, .hdr or .mp4
  std::optional<double> saveEvery;        // while it converges [s]
  std::optional<std::string> checkpoint;  // file, of a run that is not live
  bool aovs = false;
  std::optional<bool> denoise;    // nothing: as denoises() says
  std::optional<float> exposure;  // [EV]; nothing: the scene's, or by the picture
  bool autoExposure = false;      // by the picture, whatever the scene says
  ToneCurve toneCurve = ToneCurve::srgb;
  std::optional<std::string> stats;
  std::optional<std::string> metrics;  // file, of a run that is not live

  std::optional<std::string> serve;                       // ADDR:PORT for browsers
  std::optional<std::string> serveCertificate, serveKey;  // PEM files
};

inline constexpr int64_t kDefaultFrames = 64;

// Settings and scene may change from frame to frame.
inline bool isLive(const Options& o) { return o.window || o.serve || o.script || o.animate; }

// Somebody looks on, for as long as they like.
inline bool isWatched(const Options& o) { return o.window || o.serve; }

// Whether a picture's tiles come filtered, as far as the command line says.
inline bool filtersAtClients(const Options& o, PictureView view) {
  return o.filterAtClients && isLight(view);
}

// Whether the discontinuity buffer's share is found by the film (image/neighbour_share.h). Clients
// that filter send the filtered tile alone; its neighbours fade (running/frame_plan.h).
inline bool sharesNeighbours(const Options& o, Method method, PictureView view) {
  return o.converging && o.surfaceTest != SurfaceTest::none && !o.filterAtClients &&
         !isPainted(view) && !factsOf(method).isUnfiltered;
}

// Whether an output is a film, or holds colours to be looked at, not light.
inline bool isVideo(const std::string& output) { return output.ends_with(".mp4"); }
inline bool isToned(const std::string& output) {
  return output.ends_with(".png") || isVideo(output);
}

// Whether --output takes pictures one after another.
bool namesSeries(const Options& o);

// Whether a picture gets a last touch (image/denoise.h): by default those that people look at. Its
// guides are the layers, which neither filtered tiles nor methods without filter bring.
inline bool denoises(const Options& o, Method method) {
  const bool isSeen = isWatched(o) || (o.output && isToned(*o.output));
  const bool hasGuides = !o.filterAtClients && !factsOf(method).isUnfiltered;
  return hasGuides && o.denoise.value_or(isSeen && o.preset != Preset::paper);
}

// Whether a live run has no use for radiance, unless it sums frames up.
inline bool wantsCodesOnly(const Options& o) { return !o.output || isToned(*o.output); }

// `cores`: of this machine; one local client for each is the default.
Options parseOptions(int argc, const char* const* argv, const Variable& variable, int cores);

// The whole text of --help.
std::string helpText();

// Settings of the job: the options', with the scene's camera and light. Error: no such camera.
Settings makeSettings(const Options& options, const Scene& scene);

}  // namespace ninefold
