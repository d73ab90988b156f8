#include "bus/clocks/age_watch.hpp"

#include <algorithm>

namespace priamos::bus {

AgeWatch::Verdict AgeWatch::Judge(std::uint64_t sender, std::string_view channel, Duration age,
                                  Duration uncertainty, Duration waited) const {
  if (age < -(uncertainty + kJump)) return Verdict::kFuture;
  const auto kind = kinds_.find({sender, std::string(channel)});
  if (kind == kinds_.end()) return Verdict::kUsual;
  const Duration oldest = std::max(kind->second.oldest, kind->second.oldest_before);
  return age - std::max(waited, Duration::zero()) > oldest + kJump ? Verdict::kOlder : Verdict::kUsual;
}

void AgeWatch::Note(std::uint64_t sender, std::string_view channel, Duration age, Time now) {
  const std::pair key{sender, std::string(channel)};
  auto kind = kinds_.find(key);
  if (kind == kinds_.end()) {
    if (kinds_.size() >= kMostKinds) return;
    kind = kinds_.emplace(key, Ages{now, age, age}).first;
  }
  Ages& ages = kind->second;
  if (std::chrono::abs(now - ages.since) > kRemembered / 2) ages = {now, age, ages.oldest};
  ages.oldest = std::max(ages.oldest, age);
}

}  // namespace priamos::bus
