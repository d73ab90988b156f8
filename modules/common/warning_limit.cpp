#include "common/warning_limit.hpp"

#include <fmt/format.h>

#include <utility>

namespace priamos {

std::optional<std::string> WarningLimit::Take(std::string_view topic, std::string_view warning, Time now) {
  auto found = topics_.find(topic);
  if (found == topics_.end()) found = topics_.try_emplace(std::string(topic)).first;
  Topic& about = found->second;
  if (!about.rate.Due(now)) {
    ++about.left_out;
    return std::nullopt;
  }
  about.rate.Mark(now);
  const int before = std::exchange(about.left_out, 0);
  if (before == 0) return std::string(warning);
  return fmt::format("{} ({}: {} before it)", warning, topic, before);
}

std::vector<std::string> WarningLimit::LeftOut(Time now) {
  std::vector<std::string> sentences;
  for (auto& [name, topic] : topics_) {
    if (topic.left_out == 0 || !topic.rate.Due(now)) continue;
    topic.rate.Mark(now);
    sentences.push_back(fmt::format("{}: {} more refused", name, std::exchange(topic.left_out, 0)));
  }
  return sentences;
}

}  // namespace priamos
