#include "radio/newcomers.hpp"

#include <algorithm>
#include <tuple>

namespace priamos::radio {

std::optional<int> Newcomers::Admit(int id, Time now) {
  std::optional<int> leaves;
  if (all_.size() >= kMost) leaves = WorstOne();
  if (leaves) all_.erase(*leaves);
  all_[id] = {.since = now};
  return leaves;
}

int Newcomers::WorstOne() const {
  const auto rank = [](const auto& entry) {
    return std::tuple(entry.second.genuine, entry.second.bytes > 0, entry.second.since);
  };
  return std::min_element(all_.begin(), all_.end(),
                          [&](const auto& a, const auto& b) { return rank(a) < rank(b); })
      ->first;
}

bool Newcomers::OnBytes(int id, std::size_t count) {
  const auto found = all_.find(id);
  if (found == all_.end()) return false;
  found->second.bytes += count;
  return found->second.bytes <= kMostBytes;
}

void Newcomers::OnGenuine(int id) {
  const auto found = all_.find(id);
  if (found != all_.end()) found->second.genuine = true;
}

std::vector<int> Newcomers::Expired(Time now) const {
  std::vector<int> over;
  for (const auto& [id, newcomer] : all_)
    if (now - newcomer.since > kPatience) over.push_back(id);
  return over;
}

std::vector<int> Newcomers::Genuine() const {
  std::vector<int> genuine;
  for (const auto& [id, newcomer] : all_)
    if (newcomer.genuine) genuine.push_back(id);
  return genuine;
}

}  // namespace priamos::radio
