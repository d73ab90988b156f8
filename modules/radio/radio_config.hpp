#pragma once

#include <string>
#include <vector>

#include "bus/radio/link_config.hpp"
#include "common/archive.hpp"
#include "common/input/section_place.hpp"

namespace priamos::radio {

/// One of several robots of a station: a `[[robot]]` of its radio.toml. The first has address 1.
struct StationRobot {
  std::string name;  ///< as with --robot: its offboard bus has that name
  std::string key_file;
  std::string state_file, fast_state_file;
  SectionPlace place{};  ///< where it was read, for errors
  void Describe(Archive& a) {
    a.Text("name", name, "robot, as with --robot: its messages are on the offboard bus of that name");
    a.Text("key_file", key_file, "secret key of the link to this robot");
    a.Text("state_file", state_file, "as above, for this robot");
    a.Text("fast_state_file", fast_state_file, "as above, for this robot");
    NotePlace(a, place);
    if (name.empty()) a.Refuse("name", "the name of a robot");
    if (state_file.empty() && !fast_state_file.empty())
      a.Refuse("fast_state_file", "none without a state_file, which outlives a loss of power");
  }
  friend bool operator==(const StationRobot&, const StationRobot&) = default;
};

/// Contents of `config/<deployment>/radio.toml`.
struct RadioConfig {
  std::string side = "onboard";
  std::string port = "/dev/ttyUSB0";
  std::string link = "link.toml";
  std::string types;
  std::string state_file, fast_state_file;
  double tick_s = 0.001;
  int address = 0;
  std::vector<StationRobot> robots;
  bus::radio::LinkConfig own_link;  ///< used when it has channels
  SectionPlace place{};             ///< where it was read, for errors

  bool HasOwnLink() const { return !own_link.channels.empty(); }

  void Describe(Archive& a) {
    a.Choice("side", side, {"onboard", "offboard"},
             "which end of the link this is: the robot's or the workstation's");
    a.Text(
        "port", port,
        "serial port of the modem; kiss:TTY of a packet radio; or udp:HOST:PORT, tcp:HOST:PORT, tcp::PORT to "
        "wait");
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
    a.Integer("address", address,
              {"-", 0, 8,
               "of this robot on a channel that several share (link.toml: robots); 0: a link of two ends"});
    a.List("robot", robots,
           "at the station of several robots: each of them, in the order of their addresses");
    NotePlace(a, place);
    if (!robots.empty() && side != "offboard") a.Refuse("robot", "none onboard: a robot has one link");
    if (!robots.empty() && address != 0) a.Refuse("address", "0 at a station, whose robots have addresses");
    if (!robots.empty() && !state_file.empty())
      a.Refuse("state_file", "none beside [[robot]]: each of them names its own");
    if (!robots.empty() && !fast_state_file.empty())
      a.Refuse("fast_state_file", "none beside [[robot]]: each of them names its own");
    if (robots.empty() && state_file.empty() && !fast_state_file.empty())
      a.Refuse("fast_state_file", "none without a state_file, which outlives a loss of power");
    // A link.toml may be given as this file; then `link` is not read.
    own_link.Describe(a);
    if (HasOwnLink() && link != RadioConfig{}.link)
      a.Refuse("link", "none beside [[channel]] tables in the same file, which are the link");
    if (!HasOwnLink() && own_link != bus::radio::LinkConfig{})
      a.Refuse("channel", "the [[channel]] tables to which the other keys of link.toml belong");
  }
};

}  // namespace priamos::radio
