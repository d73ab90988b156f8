#include "bus/log/claimed_texts.hpp"

#include <algorithm>
#include <utility>

namespace priamos::bus {
namespace {

constexpr std::size_t kMostWork = 8;  // bytes seen, per byte kept

/// Memory of one part beside its text, about.
constexpr std::size_t kPartOverhead = 64;

}  // namespace

void ClaimedTexts::Add(std::int64_t part, std::int64_t parts, std::string text) {
  Claim& claim = by_count_[parts];
  claim.newest = ++added_;
  Versions& versions = claim.parts[part];
  const auto forget = [&](Versions::iterator at) {
    bytes_ -= at->size() + kPartOverhead;
    versions.erase(at);
  };
  if (const auto same = std::find(versions.begin(), versions.end(), text); same != versions.end())
    forget(same);
  else if (versions.size() == kMostVersions)
    forget(versions.begin());
  bytes_ += text.size() + kPartOverhead;
  versions.push_back(std::move(text));
}

void ClaimedTexts::Keep(const std::function<bool(const std::string& text)>& proves) {
  proof_at_ = added_;
  std::string seen;
  const bool proven = AnyText([&](const std::string& text) {
    seen = text;
    return proves(text);
  });
  if (!proven) return;
  bytes_ += seen.size() + kPartOverhead;
  proven_ = std::move(seen);
}

bool ClaimedTexts::AnyText(const std::function<bool(const std::string& text)>& take) const {
  std::vector<const Claim*> whole;
  for (const auto& [count, claim] : by_count_)
    if (std::cmp_equal(claim.parts.size(), count)) whole.push_back(&claim);
  std::sort(whole.begin(), whole.end(), [](const Claim* a, const Claim* b) { return a->newest > b->newest; });
  // A share of the work for each, so that none keeps the others from being tried.
  const std::size_t claims = std::clamp<std::size_t>(whole.size(), 1, kMostTries);
  whole.resize(std::min(whole.size(), claims));
  const Budget share{kMostTries / claims, kMostWork * bytes_ / claims};
  return std::any_of(whole.begin(), whole.end(),
                     [&](const Claim* claim) { return AnyTextOf(claim->parts, share, take); }) ||
         (proven_ && take(*proven_));
}

/// All choices of a version for each part, like the digits of a number that counts up; 0 is the newest one.
bool ClaimedTexts::AnyTextOf(const Parts& parts, Budget budget,
                             const std::function<bool(const std::string& text)>& take) {
  std::vector<std::size_t> age(parts.size(), 0);
  for (std::size_t seen = 0; budget.tries > 0; --budget.tries) {
    std::string text;
    std::size_t i = 0;
    for (const auto& [part, versions] : parts) text += versions[versions.size() - 1 - age[i++]];
    if (seen > 0 && seen + text.size() > budget.bytes) return false;
    seen += text.size();
    if (take(text)) return true;
    auto part = parts.begin();
    for (i = 0; i < age.size() && ++age[i] == part->second.size(); ++i, ++part) age[i] = 0;
    if (i == age.size()) return false;
  }
  return false;
}

}  // namespace priamos::bus
