// run.h: a program as a user meets it.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace ninefold {

struct Outcome {
  int status = 0;
  std::string output;  // stdout, then stderr unless the arguments say otherwise
};

inline Outcome runTool(const std::string& name, const std::string& arguments) {
  const std::string command =
      std::string(NINEFOLD_BIN) + "/" + name + " " +
      (arguments.find('>') == std::string::npos ? arguments + " 2>&1" : arguments);
  FILE* pipe = popen(command.c_str(), "r");
  Outcome run;
  char text[4096];
  while (std::fgets(text, sizeof text, pipe) != nullptr) run.output += text;
  run.status = WEXITSTATUS(pclose(pipe));
  return run;
}

}  // namespace ninefold
