#include "bus/wire/sequence_tracker.hpp"

#include <algorithm>

namespace priamos::bus {
namespace {

constexpr std::uint32_t kLatest = 64;  ///< datagrams; later than that is a sender that began anew

}  // namespace

void SequenceTracker::ForgetOldest() {
  const auto oldest = std::min_element(senders_.begin(), senders_.end(), [](const auto& x, const auto& y) {
    return x.second.heard < y.second.heard;
  });
  senders_.erase(oldest);
}

void SequenceTracker::Add(std::uint64_t sender, std::uint32_t number) {
  const auto [at, added] = senders_.try_emplace(sender);
  Sender& s = at->second;
  s.heard = ++datagrams_;
  ++s.datagrams;
  const std::uint32_t ahead = number - s.next;  // modulo 2^32, as the numbers run
  const std::uint32_t behind = s.next - number;
  if (added || ahead == 0 || (ahead > kLargestGap && behind > kLatest)) {
    s.next = number + 1;
    if (added && senders_.size() > kMostSenders) ForgetOldest();
  } else if (ahead <= kLargestGap) {
    lost_ += ahead;
    s.lost += ahead;
    s.lately_lost = std::min(ahead, kLatest);
    s.next = number + 1;
  } else if (s.lately_lost > 0) {
    --s.lately_lost;
    --s.lost;
    --lost_;
  }
}

std::vector<SenderCounters> SequenceTracker::PerSender() const {
  std::vector<SenderCounters> all;
  for (const auto& [sender, s] : senders_) all.push_back({sender, s.datagrams, s.lost});
  return all;
}

}  // namespace priamos::bus
