#include "master/web/web_state.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace ninefold {
namespace {

using nlohmann::json;

json numberOrNull(double value) { return std::isfinite(value) ? json(value) : json(); }

const char* stateOf(const ClientInfo& client) {
  switch (client.status.state) {
    case ClientState::connecting:
      return "connecting";
    case ClientState::syncing:
      return "syncing";
    case ClientState::building:
      return "building the scene";
    case ClientState::ready:
      return client.isStuck() ? "stuck" : "ready";
    case ClientState::lost:
      return "lost";
  }
  return "";
}

json clientsOf(const std::vector<ClientInfo>& clients) {
  json all = json::array();
  for (const ClientInfo& client : clients) {
    if (client.status.state == ClientState::lost || all.size() >= kMostClientsTold) continue;
    all.push_back({{"name", client.name},
                   {"state", stateOf(client)},
                   {"tasks", client.work ? client.work->tasks : 0}});
  }
  return all;
}

std::string text(const json& object) {
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

std::string stateText(const PanelView& view, const std::string& scene, const std::string& notice) {
  json state{{"scene", scene}, {"notice", notice}, {"state", view.state}};
  state["clients"] = clientsOf(view.clients);
  if (view.shown != nullptr) {
    state["frames"] = view.shown->frames;
    state["moving"] = view.shown->frame.moving;
    state["complete"] = view.complete;
    state["error"] = numberOrNull(view.shown->relativeError);
  }
  state["rays"] = view.raysPerSecond;
  state["view"] = nameOf(view.view);
  state["views"] = kViewNames;
  state["exposure"] = view.tone.exposure;
  state["auto"] = view.autoExposure;
  state["playing"] = view.playing ? json(*view.playing) : json();
  state["selection"] = view.selection ? json(view.selection->name) : json();
  state["lamps"] = view.lights;
  state["cameras"] = view.cameras;
  return text(state);
}

std::string progressText(const std::string& scene, const std::string& progress) {
  return text({{"scene", scene}, {"progress", progress}});
}

}  // namespace ninefold
