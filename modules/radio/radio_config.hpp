#pragma once

#include <string>

#include "common/config.hpp"

namespace priamos::radio {

/// config/<deployment>/radio.toml
struct RadioConfig {
  std::string side = "onboard";
  std::string port = "/dev/ttyUSB0";
  std::string link = "link.toml";
  std::string state_file;
  double tick_s = 0.001;

  void Describe(Archive& a) {
    a.Choice("side", side, {"onboard", "offboard"},
             "which end of the link this is: the robot's or the workstation's");
    a.Text("port", port, "serial port of the modem");
    a.Text("link", link,
           "channels, rates and key, the same for both ends; relative to the folder of this file");
    a.Text("state_file", state_file,
           "counters and unacknowledged events survive a restart here; empty: they do not, and the ends "
           "agree anew");
    a.Number("tick_s", tick_s, {"s", 0.0005, 0.02, "how often the line is fed"});
  }
};

}  // namespace priamos::radio
