#include "cli/terminal/replay_verdict.hpp"

#include <nlohmann/json.hpp>

namespace priamos::cli {

std::string JsonLine(const ReplayVerdict& verdict) {
  auto channels = nlohmann::ordered_json::array();
  for (const auto& [name, c] : verdict.comparison.channels)
    channels.push_back(
        {{"channel", name}, {"recorded", c.recorded}, {"replayed", c.replayed}, {"equal", c.equal}});
  const nlohmann::ordered_json json{{"log", verdict.log},
                                    {"module", verdict.module},
                                    {"fed", verdict.fed},
                                    {"skipped_bytes", verdict.skipped_bytes},
                                    {"equal", verdict.comparison.equal},
                                    {"channels", channels},
                                    {"differences", verdict.comparison.differences}};
  return json.dump();
}

}  // namespace priamos::cli
