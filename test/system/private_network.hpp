#pragma once

#include <fstream>
#include <string>

#include "test/support/shell.hpp"

namespace priamos {

/// Runs a bash script in a network of its own (loopback with multicast and nothing else), at most `seconds`.
/// `$BIN` is the folder of our programs, `$SOURCE` the source tree; `listening` waits until somebody hears
/// a bus of ours (bound to 239.255.*.67 or .68) or LCM's default port 7667 (0x1DF3). `script_file` is
/// written.
inline ShellAnswer RunInPrivateNetwork(const std::string& script, const std::string& script_file,
                                       int seconds = 30, const std::string& unshare = "unshare -rn") {
  std::ofstream(script_file)
      << "set -u\nunset PRIAMOS_NETWORK\nip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo\n"
         "BIN=" PRIAMOS_BINARY_DIR "/bin\nSOURCE=" PRIAMOS_SOURCE_DIR
         "\n"
         "listening() { until grep -qE ' 4[34]..FFEF:|:1DF3 ' /proc/net/udp; do sleep 0.05; done; "
         "sleep 0.3; }\n"
         // The clock's anchor of this network's processes, which is not that of the machine.
         "export PRIAMOS_RUNTIME=$(dirname "
      << script_file << ")/runtime\n"
      << script;
  return RunShell("timeout -k 2 " + std::to_string(seconds) + " " + unshare + " bash " + script_file);
}

}  // namespace priamos
