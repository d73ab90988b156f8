#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <vector>

#include "bus/claim.hpp"
#include "common/random.hpp"

// Two or three claims of one role on a network that loses, delays and is cut in two for a while, each with a
// clock of its own: somebody always goes on, and soon after all can hear each other it is only one.

namespace priamos::bus {
namespace {

using std::chrono::milliseconds;
using State = Claim::State;

constexpr Duration kStep{1'000};
constexpr Duration kLongestDelay{50'000};
/// Two words of each are enough; with three words of ten lost this many rounds are.
constexpr Duration kBound{2'000'000};

struct Letter {
  Duration arrival;
  std::size_t to;
  ClaimWord word;
};

/// One process with its clock, which is off by anything and up to 200 ppm fast or slow.
struct Party {
  Claim claim;
  double rate;
  Time zero;
  Duration stall_from{}, stall_to{};

  Time Now(Duration at) const {
    return zero + Duration(std::llround(rate * static_cast<double>(at.count())));
  }
  bool Stalled(Duration at) const { return at >= stall_from && at < stall_to; }
};

class Network {
 public:
  Network(std::uint64_t seed, std::size_t parties, bool stalls) : rng_(seed), loss_(rng_.Uniform(0, 0.3)) {
    cut_from_ = Draw(0, 2);
    cut_to_ = cut_from_ + Draw(0, 3);
    const bool at_once = rng_.Chance(0.5);
    for (std::size_t i = 0; i < parties; ++i) {
      starts_.push_back(at_once ? Draw(0, 0.06) : Draw(0, 4));
      rates_.push_back(rng_.Uniform(0.9998, 1.0002));
      zeros_.push_back(FromUtime(static_cast<std::int64_t>(rng_.Below(1'000'000'000'000))));
      alone_.push_back(rng_.Chance(0.5));
      const Duration from = Draw(0, 5);
      stalls_.push_back(stalls ? std::pair(from, from + Draw(0, 3)) : std::pair(Duration(), Duration()));
    }
    parties_.resize(parties);
  }

  /// Everybody is there, hears everybody, and runs.
  Duration Quiet() const {
    Duration quiet = std::max(cut_to_, *std::max_element(starts_.begin(), starts_.end())) + Claim::kAskFor;
    for (const auto& [from, to] : stalls_) quiet = std::max(quiet, to);
    return quiet;
  }
  void RunUntil(Duration end) {
    for (; at_ < end; at_ += kStep)
      for (std::size_t i = 0; i < parties_.size(); ++i) StepOne(i);
  }
  int Count(State state) const {
    return static_cast<int>(std::count_if(parties_.begin(), parties_.end(),
                                          [&](const auto& p) { return p && p->claim.state() == state; }));
  }

 private:
  Duration Draw(double low, double high) { return FromSeconds(rng_.Uniform(low, high)); }

  void StepOne(std::size_t i) {
    if (at_ < starts_[i]) return;
    auto& party = parties_[i];
    if (!party) {
      const Claimant self{"priamos", "robot", static_cast<std::int32_t>(rng_.Below(1U << 31)), "h", int(i)};
      const Time now = zeros_[i];
      party.emplace(Party{Claim(self, now), rates_[i], now - at_, stalls_[i].first, stalls_[i].second});
    }
    if (party->Stalled(at_)) return;
    const Time now = party->Now(at_);
    const bool lapsed = party->claim.Touch(now);
    for (auto letter = letters_.begin(); letter != letters_.end();) {
      const bool here = letter->to == i && letter->arrival <= at_;
      if (here && !lapsed) party->claim.Hear(letter->word, now);
      letter = here ? letters_.erase(letter) : letter + 1;
    }
    if (const auto word = party->claim.Step(now)) Send(i, *word);
  }

  void Send(std::size_t from, const ClaimWord& word) {
    for (std::size_t to = 0; to < parties_.size(); ++to) {
      const bool cut = at_ >= cut_from_ && at_ < cut_to_ && alone_[from] != alone_[to];
      if (to == from || cut || rng_.Chance(loss_)) continue;
      letters_.push_back({at_ + Duration(rng_.Below(kLongestDelay.count())), to, word});
    }
  }

  Rng rng_;
  double loss_;
  Duration at_{}, cut_from_, cut_to_;
  std::vector<Duration> starts_;
  std::vector<double> rates_;
  std::vector<Time> zeros_;
  std::vector<bool> alone_;  ///< the side of the cut
  std::vector<std::pair<Duration, Duration>> stalls_;
  std::vector<std::optional<Party>> parties_;
  std::vector<Letter> letters_;
};

void OneSurvives(std::uint64_t seed, std::size_t parties, bool stalls) {
  Network network(seed, parties, stalls);
  for (Duration at{}; at < network.Quiet(); at += milliseconds(10)) {
    network.RunUntil(at);
    const int over = network.Count(State::kRefused) + network.Count(State::kYielded);
    RC_ASSERT(over < static_cast<int>(parties));
  }
  network.RunUntil(network.Quiet() + kBound);
  RC_ASSERT(network.Count(State::kHeld) == 1);
  RC_ASSERT(network.Count(State::kAsking) == 0);
}

TEST(ClaimProperty, OfTwoExactlyOneGoesOn) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) { OneSurvives(seed, 2, false); }));
}

TEST(ClaimProperty, OfThreeExactlyOneGoesOn) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) { OneSurvives(seed, 3, false); }));
}

TEST(ClaimProperty, AlsoWhenProcessesStandStillForUpTo3Seconds) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) { OneSurvives(seed, 2 + seed % 2, true); }));
}

}  // namespace
}  // namespace priamos::bus
