// doctor_machine.h: what ninefold-doctor finds out about this machine alone.
// Errors: none thrown; what fails is a finding.   Threads: main.
#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <dlfcn.h>
#include <sys/resource.h>
#include <sys/statvfs.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <thread>

#include "client/blob_cache.h"
#include "client/identity.h"
#include "common/base/written_file.h"
#include "tools/doctor_finding.h"

namespace ninefold {

// Renders the probe scene, as a client does before it joins.
inline Finding lookAtProcessor(Isa isa, msg::Hello& hello) {
  client::Options options;
  options.isa = isa;
  options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  options.name = "doctor";
  try {
    hello = client::introduce(options);
  } catch (const std::exception& error) {
    return {Grade::bad, "processor", error.what(), "choose another --isa"};
  }
  return {Grade::good, "processor",
          fmt::format("{} with {} core(s), pixel class {}", hello.isa, hello.threads,
                      hello.probeClass)};
}

inline Finding judgeSpace(const std::filesystem::path& folder, uint64_t free) {
  constexpr double kGiB = 1ull << 30;
  const std::string found =
      fmt::format("{}, {:.1f} GiB free", folder.string(), static_cast<double>(free) / kGiB);
  if (free >= BlobCache::kDefaultMaxBytes) return {Grade::good, "cache", found};
  return {Grade::note, "cache", found,
          fmt::format("up to {:.0f} GiB are used: make room, or choose another with --cache",
                      static_cast<double>(BlobCache::kDefaultMaxBytes) / kGiB)};
}

// Makes the folder if it is not there, as a client would. `folder`: nothing if there is to be none.
// Never bad: a client goes on without a cache.
inline Finding lookAtCache(const std::optional<std::filesystem::path>& folder) {
  const std::string without = "without it the scene comes anew with each start";
  if (!folder) return {Grade::note, "cache", "none", without};
  try {
    const BlobCache cache(*folder);
    checkWritable(*folder / "probe");
  } catch (const Error& error) {
    return {Grade::note, "cache", error.what(), without};
  }
  struct statvfs space {};
  if (::statvfs(folder->c_str(), &space) != 0)
    return {Grade::note, "cache", folder->string() + " tells no free space",
            "choose another with --cache"};
  return judgeSpace(*folder, uint64_t{space.f_bavail} * space.f_frsize);
}

// A client has a socket, its cache's files and those of its libraries; a master a socket for each
// client and a pipe for each that it starts. Never bad: how many those libraries take differs, and
// the doctor, who gets here, has as many open.
inline Finding judgeDescriptors(uint64_t limit) {
  constexpr uint64_t kClient = 64, kMaster = 1024;
  const std::string found = fmt::format("{} may be open at once", limit);
  if (limit < kClient)
    return {Grade::note, "descriptors", found,
            fmt::format("few for a client: ulimit -n {}", kMaster)};
  if (limit < kMaster)
    return {Grade::note, "descriptors", found,
            fmt::format("enough for a client; a master of many wants: ulimit -n {}", kMaster)};
  return {Grade::good, "descriptors", found};
}

inline Finding lookAtDescriptors() {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  return judgeDescriptors(limit.rlim_cur);
}

// GLFW as ninefold-master uses it, but loaded here only: clients need none of it.
class WindowLibrary {
 public:
  WindowLibrary() : handle_(::dlopen("libglfw.so.3", RTLD_NOW | RTLD_LOCAL)) {}
  ~WindowLibrary() {
    if (handle_ != nullptr) ::dlclose(handle_);
  }
  WindowLibrary(const WindowLibrary&) = delete;
  WindowLibrary& operator=(const WindowLibrary&) = delete;

  bool isThere() const { return handle_ != nullptr; }
  // Whether a window that is not shown gets OpenGL 3.3.
  bool canOpen() const {
    const auto init = find<decltype(glfwInit)>("glfwInit");
    const auto hint = find<decltype(glfwWindowHint)>("glfwWindowHint");
    const auto create = find<decltype(glfwCreateWindow)>("glfwCreateWindow");
    const auto end = find<decltype(glfwTerminate)>("glfwTerminate");
    if (!init || !hint || !create || !end || init() != GLFW_TRUE) return false;
    hint(GLFW_VISIBLE, GLFW_FALSE);
    hint(GLFW_CONTEXT_VERSION_MAJOR, 3), hint(GLFW_CONTEXT_VERSION_MINOR, 3);
    const bool opened = create(64, 64, "ninefold-doctor", nullptr, nullptr) != nullptr;
    end();
    return opened;
  }

 private:
  template <typename Function>
  Function* find(const char* name) const {
    return reinterpret_cast<Function*>(::dlsym(handle_, name));
  }
  void* handle_;
};

inline Finding lookAtWindow() {
  const auto isSet = [](const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && *value != '\0';
  };
  const std::string use = "ninefold-master --window needs it, a client does not";
  if (!isSet("DISPLAY") && !isSet("WAYLAND_DISPLAY"))
    return {Grade::note, "window", "no display here", use};
  const WindowLibrary library;
  if (!library.isThere()) return {Grade::note, "window", "GLFW is not installed", use};
  if (!library.canOpen()) return {Grade::note, "window", "no OpenGL 3.3 on the display", use};
  return {Grade::good, "window", "OpenGL 3.3"};
}

}  // namespace ninefold
