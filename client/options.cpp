#include "client/options.h"

#include <unistd.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <map>
#include <sstream>

#include "client/blob_cache.h"
#include "proto/connection.h"
#include "proto/messages.h"

namespace ninefold::client {
namespace {

namespace po = boost::program_options;

constexpr unsigned kHelpWidth = 100;

struct Flag {
  const char* name;
  const char* value;
  const char* help;
};

constexpr Flag kFlags[] = {
    {"master", "ADDR:PORT",
     "the master to render for, as it says when it starts (default: the only one that announces "
     "itself on this network)"},
    {"master-file", "FILE",
     "in place of --master: a file with its addresses, which its --address-file writes; may come "
     "later"},
    {"key-file", "FILE", "cluster key: the file that the master's --new-key made, copied here"},
    {"threads", "N", "threads that render, 1 to 1024 (default: one per core)"},
    {"cache", "DIR",
     "private folder that keeps scenes, or none (default $XDG_CACHE_HOME/ninefold or "
     "~/.cache/ninefold)"},
    {"isa", "NAME", "instruction set: auto, avx2 or avx512 (default auto)"},
    {"record", "FILE",
     "keep tasks and results in FILE, for ninefold-replay-client and ninefold-replay-task"},
};

// What the master says to the clients that it starts itself; not for people.
constexpr const char* kInternalFlags[] = {"name", "key-descriptor"};

po::options_description publicFlags() {
  po::options_description flags("Options", kHelpWidth);
  for (const Flag& flag : kFlags)
    flags.add_options()(flag.name, po::value<std::string>()->value_name(flag.value), flag.help);
  flags.add_options()("help", "print this and end, as -h does")("version",
                                                                "print the release and end");
  return flags;
}

// The only short flag.
std::pair<std::string, std::string> readShortHelp(const std::string& word) {
  return {word == "-h" ? "help" : "", ""};
}

using Values = std::map<std::string, std::string>;

Values parseFlags(int argc, const char* const* argv) {
  using namespace po::command_line_style;
  po::options_description flags = publicFlags();
  for (const char* flag : kInternalFlags) flags.add_options()(flag, po::value<std::string>());
  po::variables_map parsed;
  const po::positional_options_description none;
  try {
    po::store(po::command_line_parser(argc, argv)
                  .options(flags)
                  .positional(none)
                  .extra_parser(readShortHelp)
                  .style(allow_long | long_allow_adjacent | long_allow_next)
                  .run(),
              parsed);
  } catch (const po::error& error) {
    failUsage("{}; see ninefold-client --help", error.what());
  }
  Values values;
  for (const auto& [flag, value] : parsed)
    values[flag] = flag == "help" || flag == "version" ? "1" : value.as<std::string>();
  return values;
}

void addVariables(Values& values, const Variable& variable) {
  for (const Flag& flag : kFlags)
    if (const auto value = variable(variableOfFlag(flag.name))) values.emplace(flag.name, *value);
}

Isa parseIsa(const std::string& name) {
  if (name == "auto") return Isa::automatic;
  if (name == "avx2") return Isa::avx2;
  if (name == "avx512") return Isa::avx512;
  failUsage("--isa {}: must be auto, avx2 or avx512", name);
}

// As --master has it; an address that is none is wrong usage.
void checkAddress(const std::string& master) {
  try {
    parseEndpoint(master, "--master");
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

std::string machineName() {
  char name[kMaxText] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "client";
}

std::optional<std::string> get(const Values& values, const char* flag) {
  const auto found = values.find(flag);
  return found == values.end() ? std::nullopt : std::optional(found->second);
}

int getNumber(const Values& values, const char* flag, int otherwise, int low, int high) {
  const auto text = get(values, flag);
  if (!text) return otherwise;
  return static_cast<int>(
      parseWhole(flag, *text, static_cast<uint64_t>(low), static_cast<uint64_t>(high)));
}

}  // namespace

Options parseOptions(int argc, const char* const* argv, const Variable& variable, int cores) {
  Values values = parseFlags(argc, argv);
  Options options;
  options.help = values.contains("help");
  options.version = values.contains("version");
  if (options.help || options.version) return options;
  options.keyDescriptor = getNumber(values, "key-descriptor", -1, 0, 1 << 20);
  // The master says all that its own clients need to know; what it was told itself is not for them.
  if (!options.local()) addVariables(values, variable);

  options.master = get(values, "master").value_or("");
  if (const auto file = get(values, "master-file")) options.masterFile = *file;
  if (!options.master.empty() && options.masterFile)
    failUsage("--master and --master-file exclude each other");
  if (!options.master.empty()) checkAddress(options.master);
  options.threads = getNumber(values, "threads", std::clamp(cores, 1, 1024), 1, 1024);
  options.isa = parseIsa(get(values, "isa").value_or("auto"));
  options.name = get(values, "name").value_or(machineName());
  if (const auto file = get(values, "key-file")) options.keyFile = *file;
  if (const auto file = get(values, "record")) options.record = *file;
  if (const auto folder = get(values, "cache"); !folder)
    options.cache = BlobCache::defaultFolder();
  else if (*folder != "none")
    options.cache = *folder;
  if (!options.local() && !options.keyFile)
    failUsage("--key-file FILE is missing: copy the master's key file here");
  return options;
}

std::string helpText() {
  std::ostringstream text;
  text << "Usage: ninefold-client [--master ADDR:PORT] --key-file FILE [options]\n\n"
          "Renders for a ninefold-master. Everything else, the scene included, comes from there.\n"
          "\n"
       << publicFlags()
       << "\nEach flag but --help and --version may also be given by the environment: "
          "NINEFOLD_KEY_FILE for\n"
          "--key-file. Flags win.\n"
          "Exit status: 0 the master is done, or a signal ended the client; 1 a failure (one line "
          "on\nstderr says what to do), 2 wrong usage, 3 a task that did not end.\n";
  return text.str();
}

}  // namespace ninefold::client
