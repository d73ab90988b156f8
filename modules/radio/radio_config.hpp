#pragma once

#include <string>

#include "bus/radio/link_config.hpp"
#include "common/archive.hpp"

namespace priamos::radio {

/// Contents of `config/<deployment>/radio.toml`.
struct RadioConfig {
  std::string side = "onboard";
  std::string port = "/dev/ttyUSB0";
  std::string link = "link.toml";
  std::string types;
  std::string state_file, fast_state_file;
  double tick_s = 0.001;
  bus::radio::LinkConfig own_link;  ///< used when it has channels

  bool HasOwnLink() const { return !own_link.channels.empty(); }

  void Describe(Archive& a) {
    a.Choice("side", side, {"onboard", "offboard"},
             "which end of the link this is: the robot's or the workstation's");
    a.Text("port", port, "serial port of the modem; or udp:HOST:PORT, tcp:HOST:PORT, tcp::PORT to wait");
    a.Text("link", link,
           "channels, rates and key, the same for both ends; relative to the folder of this file");
    a.Text("types", types,
           "folder of .lcm files with the types of the channels, relative to the working directory; empty: "
           "those of PRIAMOS");
    a.Text("state_file", state_file,
           "counters and unacknowledged events survive a restart here; empty: they do not, and the ends "
           "agree anew");
    a.Text("fast_state_file", fast_state_file,
           "the same on a RAM disk, so that no message waits for the disk of state_file; empty: none");
    a.Number("tick_s", tick_s, {"s", 0.0005, 0.001, "how often the line is fed; the budget counts on 0.001"});
    // A link.toml may be given as this file; then `link` is not read.
    own_link.Describe(a);
    if (!HasOwnLink() && own_link != bus::radio::LinkConfig{})
      a.Refuse("channel", "the [[channel]] tables to which the other keys of link.toml belong");
  }
};

}  // namespace priamos::radio
