#pragma once

#include <string>

#include "common/parameters/parameter_store.hpp"

namespace priamos {

/// The file of a process's parameters that differ from its configuration: TOML, `key = value`. It is read on
/// top of the configuration when the process starts, through the gate of ParameterStore::Set.

/// Puts in force what `path` holds; nothing when it is empty or there is no such file. Throws ConfigError,
/// `file:line:key: expected ..., got ...`.
void ReadSavedParameters(const std::string& path, ParameterStore& store);

/// Replaces the file by what differs now, and removes it when nothing does. It does not wait for the disk,
/// for a base may be driving: a loss of power soon after brings back the file before. Returns why not; empty:
/// done.
std::string SaveParameters(const std::string& path, const ParameterStore& store);

}  // namespace priamos
