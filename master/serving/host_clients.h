// host_clients.h: clients on other machines, which the master starts by ssh.
//
//   file      HOST [PROGRAM], one a line, # begins a remark; HOST is what ssh takes: a name of its
//             configuration, user@host, ssh://user@host:port; PROGRAM is ninefold-client there
//   command   ssh HOST, which must log in without a question (BatchMode)
//   key       the run's one-time key comes by the client's standard input and is in no file there
//   address   what the master listens on. If that is all interfaces, the address from which the
//             host sees ssh come (SSH_CONNECTION): there the master is reached
//
// Threads: pure, but for reading the file.   Errors: throw Error naming file and line.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "master/serving/started_clients.h"
#include "proto/connection.h"

namespace ninefold {

inline constexpr size_t kMostHosts = 4096;

// Whether it stands for all interfaces of this machine.
bool isAnyAddress(const std::string& host);

struct Host {
  std::string name, program = "ninefold-client";
};

std::vector<Host> readHosts(const std::filesystem::path& file);
std::vector<Host> parseHosts(std::string_view text, const std::filesystem::path& file);

// `listen`: as the master listens, with its real port; `isa`: as of --isa.
StartedClients::Plan hostPlan(const std::vector<Host>& hosts, std::shared_ptr<const Key> key,
                              const Endpoint& listen, const std::string& isa);

}  // namespace ninefold
