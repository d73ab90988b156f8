#pragma once

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

namespace priamos {

/// Writes a channel table to `file`: what driving by hand needs of the one in `deployment`, and BULK, long
/// messages towards the robot, as many as the line can carry besides. Returns `file`.
inline std::string WriteSaturatedLink(const std::string& deployment, const std::string& file) {
  std::ifstream in(deployment + "/link.toml");
  std::ofstream out(file);
  const std::array<std::string, 4> left_out{"LOOK_REQUEST", "PATH", "LANDMARK_MODEL", "HEAD_DRIVE"};
  std::string channel;
  const auto flush = [&] {
    const bool left = std::any_of(left_out.begin(), left_out.end(), [&](const std::string& name) {
      return channel.find("name = \"" + name + "\"") != std::string::npos;
    });
    if (!left) out << channel;
    channel.clear();
  };
  for (std::string line; std::getline(in, line);) {
    // An emulated line, and longer frames on it.
    if (line.starts_with("line_delay_s")) line = "line_delay_s = 0.02";
    if (line == "[[channel]]") flush();
    // Deadlines and lifetimes that the load breaks; that of the e-stop stays.
    const bool estop = channel.find("\"ESTOP\"") != std::string::npos;
    const bool state = channel.find("class = \"state\"") != std::string::npos;
    const bool broken = (line.starts_with("deadline_s") && !estop) || (line.starts_with("ttl_s") && state);
    if (!broken) channel += line + "\n";
  }
  flush();
  out << "\n[[channel]]\nname = \"BULK\"\ntype = \"health_t\"\ndirection = \"down\"\n"
         "class = \"state\"\nrate_hz = 4.7\npriority = 3\n";
  return file;
}

}  // namespace priamos
