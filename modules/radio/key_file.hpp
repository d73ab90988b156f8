#pragma once

#include <optional>
#include <string>

#include "bus/radio/frame/frame.hpp"

namespace priamos::radio {

/// Reads the link's secret key: 64 hexadecimal digits and a line feed, readable by its owner only. Throws
/// std::runtime_error with one sentence that names the mending command.
bus::radio::LinkKey ReadKeyFile(const std::string& path);

/// Writes a new random key to `path`, mode 0600; never over an existing file. Throws std::runtime_error.
void WriteNewKeyFile(const std::string& path);

/// Name of the file with the key that the link is to change to.
std::string NextKeyFile(const std::string& path);

/// The key in NextKeyFile(path); nullopt if there is no such file. The checks are those of ReadKeyFile; one
/// that is the same as `current` is refused.
std::optional<bus::radio::LinkKey> ReadNextKeyFile(const std::string& path,
                                                   const bus::radio::LinkKey& current);

/// Writes a new random key to NextKeyFile(path), beside a key that must be in order and whose owner it gets.
/// Never over an existing file. Throws std::runtime_error.
void WriteNextKeyFile(const std::string& path);

/// Puts NextKeyFile(path) in the place of `path`, at once and for good. Throws std::runtime_error, and then
/// both files are as before.
void FinishKeyChange(const std::string& path);

/// The key of emulated links, which protects nothing.
bus::radio::LinkKey SimulationKey();

}  // namespace priamos::radio
