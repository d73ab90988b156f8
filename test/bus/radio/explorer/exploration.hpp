#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "test/bus/radio/explorer/explored_run.hpp"

/// Every world with at most so many accidents, one after the other.
namespace priamos::bus::radio {

/// What an exploration has found.
struct Explored {
  std::size_t runs = 0;
  std::vector<std::string> findings{};  ///< the accidents and the promise that they broke, the first hundred
};

/// Runs all worlds with up to `depth` accidents. Only those are run whose first accident is at a place with
/// place % parts == part, so that several processes can share the work.
Explored Explore(const ExploredWorld& world, int depth, std::size_t part = 0, std::size_t parts = 1);

/// A world with `accidents` accidents at random.
std::vector<Mishap> RandomMishaps(const ExploredWorld& world, std::size_t accidents, std::uint64_t seed);

/// The accidents as text, for a finding.
std::string TextOf(const std::vector<Mishap>& mishaps);

}  // namespace priamos::bus::radio
