// master_address.h: where the master is: an address, or a file in which the master writes its
// addresses when it listens (ninefold-master --address-file), as launchers need it that choose no
// port. The file is read before each attempt: it may come later, or change with the master.
//
//   file      ADDR:PORT, one a line, at most kMostAddresses; they are dialled by turns
//
// Threads: one at a time.   Owner: the program.
// Errors: next() throws Error: no such file yet, or something else in it.
#pragma once

#include <filesystem>
#include <string_view>
#include <variant>
#include <vector>

#include "proto/connection.h"

namespace ninefold::client {

class MasterAddress {
 public:
  static constexpr size_t kMostAddresses = 64;
  static constexpr size_t kMostBytes = 16 << 10;

  explicit MasterAddress(Endpoint only) : where_(std::move(only)) {}
  explicit MasterAddress(std::filesystem::path file) : where_(std::move(file)) {}

  // To be dialled now.
  Endpoint next();

 private:
  std::variant<Endpoint, std::filesystem::path> where_;
  size_t turn_ = 0;
};

// What such a file holds; at least one address. `file` is for errors.
std::vector<Endpoint> parseAddresses(std::string_view text, const std::filesystem::path& file);

}  // namespace ninefold::client
