#pragma once

#include <string>

#include "bus/radio/frame/frame.hpp"

namespace priamos::radio {

/// Reads the link's secret key: 64 hexadecimal digits and a line feed, readable by its owner only. Throws
/// std::runtime_error with one sentence that names the mending command.
bus::radio::LinkKey ReadKeyFile(const std::string& path);

/// Writes a new random key to `path`, mode 0600; never over an existing file. Throws std::runtime_error.
void WriteNewKeyFile(const std::string& path);

/// The key of emulated links, which protects nothing.
bus::radio::LinkKey SimulationKey();

}  // namespace priamos::radio
