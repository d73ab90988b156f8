#pragma once

#include <string>

#include "common/archive.hpp"

namespace priamos::head {

/// `[video]` of head.toml.
struct VideoConfig {
  std::string address = "127.0.0.1";
  int port = 0;  ///< 0: there is no video link
  int ports = 1;
  std::string token_file;
  double rate_hz = 5;
  int quality = 60;

  void Describe(Archive& a);
};

}  // namespace priamos::head
