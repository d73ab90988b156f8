#pragma once

#include <fstream>
#include <regex>
#include <string>

#include "test/support/shell.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos {

/// The first shell block behind a line of a README.
inline std::string ScriptOfReadme(const std::string& readme, const std::string& heading) {
  std::ifstream in(std::string(PRIAMOS_SOURCE_DIR) + "/" + readme);
  std::string line, script;
  while (std::getline(in, line) && line != heading) {
  }
  while (std::getline(in, line) && line != "```sh") {
  }
  while (std::getline(in, line) && line != "```") script += line + "\n";
  return script;
}

/// What a script says that runs in a network of its own, in the repository, with the programs in the PATH;
/// what it leaves running is ended.
inline std::string RunInPrivateNetwork(const std::string& script, int seconds) {
  const TemporaryFolder folder;
  const std::string file = folder / "script.sh";
  std::ofstream(file) << "ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo\n"
                      << "export PATH=" << PRIAMOS_BINARY_DIR << "/bin:$PATH; cd " << PRIAMOS_SOURCE_DIR
                      << "\ntrap 'kill $(jobs -p)' EXIT\n"
                      // Names in /tmp are shared by everybody on the machine.
                      << std::regex_replace(script, std::regex("/tmp/"), folder.path().string() + "/");
  return RunShell("timeout " + std::to_string(seconds) + " unshare -rn bash " + file).text;
}

}  // namespace priamos
