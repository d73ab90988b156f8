#include "cli/scenario/door_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

#include "common/nearest_word.hpp"

namespace priamos::cli {

int DoorNamed(const GroundPlan& plan, const std::string& name, const std::string& map) {
  std::vector<std::string> known;
  for (const DoorPlan& door : plan.doors) {
    if (door.name == name) return door.id;
    known.push_back(door.name);
  }
  int id = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), id);
  if (!name.empty() && error == std::errc() && end == name.data() + name.size() && id >= 1 && id <= 999)
    return id;
  throw ConfigError(fmt::format("unknown door \"{}\"{}; {} has {}", name, NearestText(name, known), map,
                                known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
}

}  // namespace priamos::cli
