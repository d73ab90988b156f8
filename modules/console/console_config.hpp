#pragma once

#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/pilot/pilot_config.hpp"
#include "common/robot/body_size.hpp"

namespace priamos::console {

/// The body that is drawn.
struct DrawnBody {
  double length_m = kDrawnBody.length_m, width_m = kDrawnBody.width_m;

  void Describe(Archive& a);
};

/// Contents of `config/<deployment>/console.toml`.
struct ConsoleConfig {
  std::string map = "maps/door.toml";  ///< ground plan, relative to the folder of this file
  std::string link = "link.toml";      ///< channels of the radio, relative to the folder of this file
  std::string address = "127.0.0.1";
  int port = 8080, ports = 10;
  std::string token_file;
  std::string certificate_file, key_file;  ///< of TLS; both or none
  std::string foxglove_origins;
  std::string audit_file;
  std::string video;  ///< `http://HOST:PORT` of the head's video link; empty: there is none
  std::string video_token_file;
  int pages = 16;
  double rate_hz = 200;
  double beat_hz = 20;
  double freshness_s = 0.22;
  double place_sigma_m = 0.15;
  double place_sigma_deg = 5;
  DrawnBody body;
  PilotConfig pilot;

  void Describe(Archive& a);
};

/// The words of a text, which blanks separate.
std::vector<std::string> WordsOf(const std::string& text);

}  // namespace priamos::console
