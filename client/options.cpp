#include "client/options.h"

#include <unistd.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <cctype>
#include <sstream>
#include <thread>

#include "client/blob_cache.h"
#include "proto/messages.h"

namespace ninefold::client {
namespace {

namespace po = boost::program_options;

po::options_description publicFlags() {
  po::options_description flags("Options");
  auto add = flags.add_options();
  add("help", "print this and exit");
  add("master", po::value<std::string>()->value_name("ADDR:PORT"), "the master to render for");
  add("threads", po::value<int>()->value_name("N"), "threads that render; default: one per core");
  add("key-file", po::value<std::string>()->value_name("FILE"),
      "cluster key: the master's file (made by ninefold-master --new-key), copied here");
  add("cache", po::value<std::string>()->value_name("DIR"),
      "folder that keeps scenes; none: no folder; default: $XDG_CACHE_HOME/ninefold or "
      "~/.cache/ninefold");
  add("isa", po::value<std::string>()->value_name("NAME"),
      "instruction set: auto, avx2 or avx512; default: auto");
  return flags;
}

// What the master says to the clients that it starts itself.
po::options_description allFlags() {
  po::options_description flags = publicFlags();
  flags.add_options()("name", po::value<std::string>())("key-descriptor", po::value<int>());
  return flags;
}

// NINEFOLD_KEY_FILE -> key-file; names that are no flag of ours are somebody else's.
std::string flagOfVariable(const std::string& variable) {
  constexpr std::string_view kPrefix = "NINEFOLD_";
  if (!variable.starts_with(kPrefix)) return {};
  std::string flag = variable.substr(kPrefix.size());
  std::ranges::transform(flag, flag.begin(), [](unsigned char c) {
    return c == '_' ? '-' : static_cast<char>(std::tolower(c));
  });
  return publicFlags().find_nothrow(flag, false) != nullptr && flag != "help" ? flag : "";
}

po::variables_map parse(int argc, const char* const* argv) {
  po::variables_map values;
  try {
    const auto flags = allFlags();
    const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
    const po::positional_options_description none;
    po::store(
        po::command_line_parser(argc, argv).options(flags).positional(none).style(style).run(),
        values);
    if (values.contains("key-descriptor")) return values;  // then all is said in the arguments
    po::store(po::parse_environment(flags, flagOfVariable), values);
  } catch (const po::error& error) {
    throw UsageError(fmt::format("{}; see ninefold-client --help", error.what()));
  }
  return values;
}

template <typename T>
std::optional<T> get(const po::variables_map& values, const char* flag) {
  return values.contains(flag) ? std::optional<T>(values[flag].as<T>()) : std::nullopt;
}

Isa parseIsa(const std::string& name) {
  if (name == "auto") return Isa::automatic;
  if (name == "avx2") return Isa::avx2;
  if (name == "avx512") return Isa::avx512;
  throw UsageError(fmt::format("--isa {}: must be auto, avx2 or avx512", name));
}

std::string machineName() {
  char name[kMaxText] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "client";
}

}  // namespace

Options parseOptions(int argc, const char* const* argv) {
  const po::variables_map values = parse(argc, argv);
  Options options;
  options.help = values.contains("help");
  if (options.help) return options;

  options.master = get<std::string>(values, "master").value_or("");
  if (options.master.empty())
    throw UsageError("--master ADDR:PORT is missing; the master prints it when it starts");
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  options.threads = get<int>(values, "threads").value_or(std::min(cores, 1024));
  if (options.threads < 1 || options.threads > 1024)
    throw UsageError(fmt::format("--threads {}: must be 1 to 1024", options.threads));
  options.isa = parseIsa(get<std::string>(values, "isa").value_or("auto"));
  options.name = get<std::string>(values, "name").value_or(machineName());
  options.keyDescriptor = get<int>(values, "key-descriptor").value_or(-1);
  if (const auto file = get<std::string>(values, "key-file")) options.keyFile = *file;
  const auto folder = get<std::string>(values, "cache");
  if (!folder)
    options.cache = BlobCache::defaultFolder();
  else if (*folder != "none")
    options.cache = *folder;
  if (!options.local() && !options.keyFile)
    throw UsageError("--key-file FILE is missing: copy the master's key file here");
  return options;
}

std::string helpText() {
  std::ostringstream text;
  text << "Usage: ninefold-client --master ADDR:PORT --key-file FILE [options]\n\n"
          "Renders for a Ninefold master. Everything else, the scene included, comes from there.\n"
          "Ends with status 0 when the master is done, 1 on a failure, 2 on wrong usage.\n\n"
       << publicFlags()
       << "\nEach flag may also be given by the environment: NINEFOLD_KEY_FILE for --key-file.\n";
  return text.str();
}

}  // namespace ninefold::client
