#pragma once

#include <cstdint>
#include <string>

#include "world/generation.hpp"

namespace priamos::cli {

/// What was written of a generated world, relative to the folder.
struct GeneratedFiles {
  std::string scenario;  ///< its name
  std::string world, map, truth;
};

/// What the robot does in a generated building.
enum class GeneratedTask {
  kDoor,          ///< passes the door; where there is none, drives to the places of a corridor
  kThereAndBack,  ///< is sent to a place behind the door, and back; in a corridor as above
  kCorridor,      ///< follows the corridor to its end; in a room the door
  kExplore,       ///< explores it without a plan
};

/// Writes a world as a scenario of the deployment in `folder`, which is made of the files of the deployment
/// in `base` where it is not there yet. Files of the same kind and seed are replaced. Throws ConfigError when
/// the folder cannot be written, or has no configuration and is not empty.
GeneratedFiles WriteGenerated(const world::GeneratedWorld& generated, const std::string& kind,
                              std::uint64_t seed, GeneratedTask task, const std::string& base,
                              const std::string& folder);

}  // namespace priamos::cli
