// settings_flags.h: the settings of settings_table.h as flags: texts for --help, and values from
// what was written.
// Threads: pure.   Errors: UsageError with one line that names the flag.
#pragma once

#include <string>
#include <vector>

#include "common/scene/settings.h"
#include "master/options/options_flags.h"

namespace ninefold {

struct SettingFlag {
  const char* name;
  const char* value;  // what stands for its value in the help
  std::string help;   // with range, default and what presets make of it
};

// In the order of the table.
std::vector<SettingFlag> settingFlags();

// Overwrites what was given.
void readSettings(const RawOptions& raw, Settings& settings);

}  // namespace ninefold
