#include "common/scene/file_search.h"

#include "common/base/error.h"

namespace ninefold {

std::optional<std::string> findFile(const SceneFolder& folder, const std::string& beside,
                                    const std::string& name) {
  const std::string bare = name.substr(name.rfind('/') + 1);
  const auto first = [&](const auto& find) -> std::optional<std::string> {
    for (const std::string& path : {beside + name, name, beside + bare, bare}) try {
        if (std::string file = find(path); !file.empty()) return file;
      } catch (const Error&) {  // leads elsewhere: the next may not
      }
    return {};
  };
  const auto exact = first([&](const auto& p) { return folder.exists(p) ? p : std::string(); });
  return exact ? exact : first([&](const auto& p) { return folder.spelled(p); });
}

}  // namespace ninefold
