// ninefold-doctor --master ADDR:PORT [--key-file FILE] [--cache DIR] [--isa NAME]: can this machine
// join that master?
//
// Visits it as no client does: it gets no task and changes nothing there. One line for each thing
// that it looked at: what, found, what to do. The environment variables are those of
// ninefold-client.
// Exit status: 0 it can, 1 it cannot, 2 wrong usage.
#include <unistd.h>

#include "tools/command.h"
#include "tools/doctor_machine.h"
#include "tools/doctor_verdict.h"

namespace ninefold {
namespace {

// Runs before anything that the compiler has made for the processors that we need.
[[gnu::constructor(101), gnu::target("arch=x86-64")]] void refuseOldProcessor() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("bmi2"))
    return;
  static const char line[] =
      "BAD   processor        lacks AVX2, FMA or BMI2, which every Ninefold program needs; take a "
      "machine of 2013 or later (x86-64-v3)\n";
  if (::write(STDOUT_FILENO, line, sizeof line - 1) < 0) ::_exit(2);
  ::_exit(1);
}

namespace po = boost::program_options;

struct Options {
  std::string master, keyFile, cache, isa;
};

Options readOptions(int argc, char** argv, bool& end) {
  Options o;
  Command command{
      "ninefold-doctor", "--master ADDR:PORT [options]",
      "Can this machine join that master? One line for each thing that is looked at.\n"};
  const auto text = [](std::string& value, const char* name) {
    return po::value(&value)->value_name(name);
  };
  command.flags.add_options()("master", text(o.master, "ADDR:PORT"), "as ninefold-client has it")(
      "key-file", text(o.keyFile, "FILE"), "cluster key: the master's, copied here")(
      "cache", text(o.cache, "DIR"), "the client's private folder, or none")(
      "isa", text(o.isa, "NAME"), "instruction set: auto, avx2 or avx512 (default auto)");
  end = !parseCommandLine(argc, argv, command);
  if (end) return o;
  const std::pair<const char*, std::string*> flags[] = {
      {"master", &o.master}, {"key-file", &o.keyFile}, {"cache", &o.cache}, {"isa", &o.isa}};
  for (const auto& [flag, value] : flags)
    if (value->empty()) *value = processVariable(variableOfFlag(flag)).value_or("");
  if (o.master.empty())
    failUsage("--master ADDR:PORT is missing; the master says it when it starts");
  return o;
}

Isa isaNamed(const std::string& name) {
  if (name.empty() || name == "auto") return Isa::automatic;
  if (name == "avx2") return Isa::avx2;
  if (name == "avx512") return Isa::avx512;
  failUsage("--isa {}: must be auto, avx2 or avx512", name);
}

std::optional<std::filesystem::path> cacheOf(const Options& o) {
  if (o.cache == "none") return std::nullopt;
  if (o.cache.empty()) return BlobCache::defaultFolder();
  return o.cache;
}

struct VisitKey {
  std::shared_ptr<const Key> key;
  std::optional<Finding> trouble;  // it is none of the user's
};

// A key of our own making still shows whether a master answers: it says that it has another one.
VisitKey keyOf(const Options& o) {
  const auto made = std::make_shared<const Key>(Key::random());
  if (o.keyFile.empty())
    return {made, Finding{Grade::bad, "key", "none is given",
                          "copy the master's here and give it: --key-file FILE"}};
  try {
    return {std::make_shared<const Key>(Key::load(o.keyFile)), {}};
  } catch (const Error& error) {
    return {made, Finding{Grade::bad, "key", error.what()}};
  }
}

void add(Findings& all, const Findings& more) { all.insert(all.end(), more.begin(), more.end()); }

Findings lookAtMaster(const Options& o, const Endpoint& master, const msg::Hello& hello) {
  const VisitKey key = keyOf(o);
  const VisitFacts facts = Visit(master, key.key, hello).run();
  Findings all = judgeReach(facts, master, key.trouble);
  add(all, judgeVisit(facts, hello));
  return all;
}

int run(int argc, char** argv) {
  bool end = false;
  const Options o = readOptions(argc, argv, end);
  if (end) return 0;
  Endpoint master;
  try {
    master = parseEndpoint(o.master, "--master");
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  msg::Hello hello;
  Findings all{lookAtProcessor(isaNamed(o.isa), hello)};
  add(all, {lookAtCache(cacheOf(o)), lookAtDescriptors(), lookAtWindow()});
  add(all, lookAtMaster(o, master, hello));
  std::string text;
  for (const Finding& finding : all) text += lineOf(finding);
  writeOutput(text);
  const auto bad = std::ranges::count_if(all, isBad);
  if (bad == 0) return writeOutput("this machine can join\n"), 0;
  return writeOutput(fmt::format("this machine cannot join: {} thing(s) above\n", bad)), 1;
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  return ninefold::runProgram("ninefold-doctor", [&] { return ninefold::run(argc, argv); });
}
