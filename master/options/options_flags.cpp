#include "master/options/options_flags.h"

#include <fmt/format.h>

#include <boost/program_options.hpp>
#include <sstream>

#include "common/scene/settings_table.h"
#include "master/options/options.h"
#include "master/options/settings_flags.h"

namespace ninefold {
namespace {

namespace po = boost::program_options;

constexpr unsigned kHelpWidth = 100;
constexpr const char* kScene = "scene";  // the word that belongs to no flag

struct Flag {
  const char* name;
  const char* value;  // what stands for its value in the help; null: a switch
  const char* help;
};

constexpr Flag kPicture[] = {
    {"camera", "NAME|INDEX|SPEC",
     "a camera of the scene, or eye:target:fov, e.g. 0,1,5:0,1,0:50; with :3m it is orthographic "
     "and "
     "its picture 3 m high (default: the first one)"},
    {"sky", "A:E[:T]",
     "light from outside: a clear sky and its sun at azimuth A (0 to 360, clockwise from north, "
     "-z) and elevation E (0 to 90), turbidity T (2 clear to 10 hazy; default 3)"},
    {"light-units", "NAME",
     "what a glTF file's candela and lux are: radiometric (1 cd is 1 W/sr), photometric (683 cd "
     "are), or auto, by who wrote the file (default auto; docs/light-units.md)"},
    {"exposure", "EV|auto",
     "brightness of .png files and of what is looked at, -50 to 50, or by the first picture "
     "itself, "
     "held from then on (default: what the scene says, else, and under a picture or sky, auto)"},
    {"tone-map", "NAME",
     "how light becomes the colours of .png files and of what is looked at: srgb (as it is, lamps "
     "rolled off), filmic or agx (default srgb; common/image/tone_map.h)"},
    {"denoise", "off|on",
     "a last touch of filtering, by no more than a pixel's standard error (default: on in the "
     "window and for .png, else off; off for path tracing, paper and --filter-at clients)"},
    {"view", "NAME",
     "what to show: beauty (default), albedo, normal, depth, direct, indirect, caustics, sets, "
     "error, clients, objects or weights"},
};
constexpr Flag kPreset{
    "preset", "NAME",
    "interactive, final (more of everything), paper (the paper's numbers, sampling and filter), "
    "segovia, dmitriev or ren (bidirectional instant radiosity, selective photons and intersection "
    "fields as published); "
    "flags given beside it win (default interactive)"};
constexpr Flag kFilter{
    "filter", "surface|paper|none",
    "neighbours that the discontinuity buffer averages: on one smooth surface, within the paper's "
    "thresholds, or none (default surface; paper paper)"};
constexpr Flag kRun[] = {
    {"frames", "N",
     "stop after N frames (default 64 if no other stop is given); with --window or --serve: frames "
     "of a picture that rests (default without end)"},
    {"seconds", "S", "stop after S seconds"},
    {"until-error", "E",
     "stop when the relative standard error is below E; looked at after 16, 32, 64... frames"},
    {"animate", "T0:T1:FPS",
     "play the scene's animation from T0 to T1 [s] into --output out.####.exr or out.mp4, --frames "
     "N "
     "for each picture; with --window or --serve over and over"},
    {"shutter", "S",
     "motion blur of --animate and --script: a picture's frames are spread over the fraction S of "
     "the time to the next picture, 0 to 1 (default 0)"},
    {"photon-scene", "FILE",
     "a simpler scene, glTF or OBJ, that the photon map's photons meet in place of SCENE; the "
     "lamps "
     "are those of SCENE"},
    {"clip", "NAME",
     "which of the file's animations plays (default: the first; the log names them)"},
    {"window", nullptr, "walk, select and edit in a window; --output then gets the last picture"},
    {"serve", "ADDR:PORT",
     "the same in browsers (docs/browser.md); port 0 takes a free one; prints the address to open, "
     "which has a token. Beyond this machine, e.g. 0.0.0.0:8443, with TLS"},
    {"serve-certificate", "FILE",
     "PEM, with --serve-key: the certificate to show (default: one made on the spot, its "
     "fingerprint "
     "printed)"},
    {"serve-key", "FILE", "PEM: the private key of --serve-certificate"},
    {"script", "FILE",
     "replay the camera paths and edits of a JSON file (docs/script.md), in real time or, if it "
     "says so and nobody looks on, into --output out.####.png or out.mp4"},
    {"frame-time", "MS",
     "target while something moves, held by smaller and thinner frames, 1 to 10000 (default 100)"},
    {"step-time", "MS",
     "then, of each step that renews a part of selective photons, 1 to 10000 (default: half of "
     "frame-time, the first one all of it)"},
    {"headless", nullptr, "no window (default)"},
};
constexpr Flag kCluster[] = {
    {"local-clients", "N",
     "client processes started on this machine, 0 = only remote ones (default: one per core)"},
    {"client-threads", "N", "threads of each local client, 1 to 1024 (default 1)"},
    {"listen", "ADDR:PORT",
     "where clients connect; port 0 takes a free one and prints it; 0.0.0.0:4700 for a LAN "
     "(default 127.0.0.1:0)"},
    {"address-file", "FILE",
     "write there where the master listens, ADDR:PORT lines, for --master-file of clients"},
    {"announce", nullptr,
     "with --listen beyond this machine: tell the network this machine's name, port and release by "
     "DNS-SD (Avahi), so that clients need no --master; they still need the key"},
    {"hosts", "FILE",
     "start a client on each of these machines by ssh, HOST [PROGRAM] a line, again when it ends"},
    {"key-file", "FILE", "cluster key; needed to listen beyond this machine"},
    {"new-key", "FILE", "make a cluster key and end"},
    {"wait-clients", "N", "do not start before N clients are ready (default 1)"},
    {"filter-at", "master|clients",
     "who filters: clients then send finished tiles, a third of the bytes or, while something "
     "moves in a window, a quarter, and trace a border twice (default master)"},
    {"wire-level", "auto|N",
     "lossless compression of results, zstd's levels 1 to 19, 0 = none; auto: what suits each "
     "client's line (default auto)"},
    {"verify", "P",
     "a fraction of all results, 0 to 1, is done again by a second client; where two differ a "
     "third "
     "settles it, who is wrong is expelled, and what it sent is done anew (default 0)"},
    {"patience", "S",
     "when all clients are stuck, each in a task that does not end, wait for S seconds, then end "
     "with what there is, unless somebody looks on (default 120)"},
    {"isa", "NAME", "instruction set of local clients: auto, avx2 or avx512 (default auto)"},
};
constexpr Flag kFiles[] = {
    {"output", "FILE",
     "the picture: .exr (linear), .hdr (linear) or .png; of --animate and --script also a film, "
     ".mp4, which needs the program ffmpeg"},
    {"save-every", "S",
     "write the picture, and the checkpoint, each S seconds while it converges, the picture also "
     "after the first frame; a run without a window that makes one picture does so by SIGUSR1, "
     "too"},
    {"checkpoint", "FILE",
     "keep film and state of such a run, each minute or as --save-every says, and at its end; the "
     "same command goes on where the file is, with the same bytes"},
    {"aovs", nullptr,
     "more layers in the .exr: albedo, N, Z, irradiance, caustic, error, object id"},
    {"stats", "FILE", "what happened, as JSON; - is standard output"},
    {"metrics", "FILE.prom",
     "of a run without a window that makes one picture: what --serve gives at /metrics, anew each "
     "10 s, for a collector of text files"},
    {"help", nullptr, "print this and end, as -h does"},
    {"version", nullptr, "print the release and end"},
};

void add(po::options_description& group, const Flag& flag) {
  if (flag.value == nullptr)
    group.add_options()(flag.name, flag.help);
  else
    group.add_options()(flag.name, po::value<std::string>()->value_name(flag.value), flag.help);
}

po::options_description group(const char* title, std::span<const Flag> flags) {
  po::options_description group(title, kHelpWidth);
  for (const Flag& flag : flags) add(group, flag);
  return group;
}

// What is seen, in the first group; and how it is computed, in the second.
void addSettings(po::options_description& picture, po::options_description& method) {
  constexpr Setting<int> side = settingOf(&Settings::width);
  const Settings usual;
  const std::string size = fmt::format("pixels, each {} to {} (default {}x{})", side.low, side.high,
                                       usual.width, usual.height);
  add(picture, {"size", "WxH", size.c_str()});
  const std::string_view environment = settingOf(&Settings::environment).name;
  for (const SettingFlag& flag : settingFlags())
    add(flag.name == environment ? picture : method, {flag.name, flag.value, flag.help.c_str()});
}

po::options_description allFlags() {
  po::options_description picture("Picture", kHelpWidth), method("Method", kHelpWidth);
  add(method, kPreset);
  addSettings(picture, method);
  add(method, kFilter);
  for (const Flag& flag : kPicture) add(picture, flag);
  po::options_description all(kHelpWidth);
  all.add(picture).add(method).add(group("Run", kRun));
  all.add(group("Cluster", kCluster)).add(group("Files", kFiles));
  return all;
}

// The only short flag: a number with a minus is a value.
std::pair<std::string, std::string> readShortHelp(const std::string& word) {
  return {word == "-h" ? "help" : "", ""};
}

po::variables_map parseFlags(int argc, const char* const* argv,
                             const po::options_description& all) {
  using namespace po::command_line_style;
  po::options_description known;
  known.add(all).add_options()(kScene, po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add(kScene, -1);
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv)
                .options(known)
                .positional(positional)
                .extra_parser(readShortHelp)
                .style(allow_long | long_allow_adjacent | long_allow_next)
                .run(),
            values);
  return values;
}

// Without a value.
bool isSwitch(const po::options_description& all, const std::string& flag) {
  const po::option_description* known = all.find_nothrow(flag, false);
  return known != nullptr && known->semantic()->max_tokens() == 0;
}

std::string flagValue(const std::string& flag, const po::variable_value& value) {
  const auto& text = value.as<std::string>();
  if (text.starts_with("--")) failUsage("--{} needs a value, not {}", flag, text);
  return text;
}

std::string onlyScene(const std::vector<std::string>& words) {
  for (const std::string& word : words)
    if (word.starts_with('-')) failUsage("{} is no option; see ninefold-master --help", word);
  if (words.size() > 1) failUsage("more than one scene is given: {} and {}", words[0], words[1]);
  return words[0];
}

}  // namespace

RawOptions::RawOptions(int argc, const char* const* argv, const Variable& variable) {
  const po::options_description all = allFlags();
  try {
    const po::variables_map given = parseFlags(argc, argv, all);
    for (const auto& [flag, value] : given)
      if (flag != kScene) values_[flag] = isSwitch(all, flag) ? "1" : flagValue(flag, value);
    if (given.contains(kScene))
      values_[kScene] = onlyScene(given[kScene].as<std::vector<std::string>>());
  } catch (const po::error& error) {
    failUsage("{}; see ninefold-master --help", error.what());
  }
  for (const auto& option : all.options()) {
    const std::string& flag = option->long_name();
    if (flag == "help" || flag == "version" || flag == "new-key" || has(flag)) continue;
    if (const auto value = variable(variableOfFlag(flag))) values_[flag] = *value;
  }
}

std::optional<std::string> RawOptions::text(const std::string& flag) const {
  const auto found = values_.find(flag);
  return found == values_.end() ? std::nullopt : std::optional(found->second);
}

bool RawOptions::isOn(const std::string& flag) const {
  const std::string value = text(flag).value_or("0");
  if (value != "0" && value != "1")
    failUsage("{} is {}: must be 0 or 1", variableOfFlag(flag), value);
  return value == "1";
}

std::optional<size_t> RawOptions::choice(const std::string& flag,
                                         std::span<const char* const> names) const {
  const auto given = text(flag);
  if (!given) return std::nullopt;
  std::string list;
  for (size_t i = 0; i < names.size(); ++i) {
    if (*given == names[i]) return i;
    list += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + std::string(names[i]);
  }
  failUsage("--{} {}: must be {}", flag, *given, list);
}

std::optional<int64_t> RawOptions::whole(const std::string& flag, uint64_t low,
                                         uint64_t high) const {
  const auto value = text(flag);
  if (!value) return std::nullopt;
  return static_cast<int64_t>(parseWhole(flag, *value, low, high));
}

std::optional<double> RawOptions::real(const std::string& flag, double low, double high) const {
  const auto value = text(flag);
  if (!value) return std::nullopt;
  const std::vector<double> numbers = parseNumbers(flag, *value);
  if (numbers.size() != 1) failUsage("--{} {}: must be one number", flag, *value);
  return checkRange(flag, numbers[0], low, high);
}

std::string helpText() {
  std::ostringstream text;
  text
      << "Usage: ninefold-master SCENE [options]\n"
         "\n"
         "Renders a scene (.gltf, .glb or .obj) with global illumination on a cluster of clients,\n"
         "by default on the cores of this machine:\n"
         "\n"
         "  ninefold-master scenes/table_room.glb --frames 64 --output table_room.exr\n"
         "\n"
      << allFlags()
      << "\n"
         "Each flag but --help, --version and --new-key may also be given by the environment:\n"
         "NINEFOLD_LOCAL_CLIENTS=4 for --local-clients 4, NINEFOLD_AOVS=1 for --aovs. Flags win.\n"
         "Exit status: 0 done, 1 a failure (one line on stderr says what to do), 2 wrong usage,\n"
         "128 + N ended by signal N, with the picture so far written: 130 Ctrl-C, 143 SIGTERM,\n"
         "129 SIGHUP, 141 SIGPIPE.\n"
         "SIGUSR1 asks for the picture so far, as --save-every does; SIGUSR2 asks what is under "
         "way:\n"
         "lines \"state: ...\" on stderr. Nothing else changes.\n";
  return text.str();
}

}  // namespace ninefold
