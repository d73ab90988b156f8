#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "numbered_message.hpp"

namespace priamos::bus::radio {

/// A line that is up in windows of 1 s, 15 % of the time, dark for 1 to 30 s in between.
struct Blackouts {
  int returns = 0;
  double slowest_fresh_s = 0;   ///< from a return to a pose that was made after it
  double oldest_command_s = 0;  ///< when it was delivered
  int commands = 0;
  bool events_once_in_order = true;
};

inline std::vector<LineCut> DarkMostOfTheTime(Rng& rng, double until_s) {
  std::vector<LineCut> cuts;
  double t = 5;
  while (t < until_s) {
    // 1 s plus an exponential of 4.67 s: 1/0.15 s from window to window in the mean.
    const double dark = std::min(30.0, 1 + std::exponential_distribution<>(1 / 4.67)(rng.engine()));
    cuts.push_back({t, t + dark});
    t += dark + 1;
  }
  return cuts;
}

class BlackoutRun {
 public:
  BlackoutRun(std::uint64_t seed, double seconds) : BlackoutRun(Cuts(seed, seconds), seed, seconds) {}

  Blackouts Run() {
    pair_.each_step = [this] { Step(); };
    pair_.Run(seconds_ + 60);
    result_.events_once_in_order =
        pair_.offboard.TextsOf(kEventUp) == up_ && pair_.onboard.TextsOf(kEventDown) == down_;
    return result_;
  }

 private:
  static std::vector<LineCut> Cuts(std::uint64_t seed, double seconds) {
    Rng rng = Rng::Stream(seed, "blackouts");
    return DarkMostOfTheTime(rng, seconds);
  }
  static LineConfig CutLine(std::vector<LineCut> cuts) {
    LineConfig line;
    line.cuts = std::move(cuts);
    return line;
  }
  BlackoutRun(const std::vector<LineCut>& cuts, std::uint64_t seed, double seconds)
      : cuts_(cuts), seconds_(seconds), pair_(CutLine(cuts), seed), start_(pair_.now) {}

  void Step() {
    const double s = Seconds(pair_.now - start_);
    if (ToUtime(pair_.now) % 20'000 == 0) {
      Offer(pair_.onboard, kPoseUp, 10);
      Offer(pair_.offboard, kDriveDown, 5);
    }
    if (ToUtime(pair_.now) % 10'000'000 == 0 && s < seconds_ - 60) OfferEvents(s);
    if (next_cut_ < cuts_.size() && s >= cuts_[next_cut_].to_s)
      returned_ = start_ + FromSeconds(cuts_[next_cut_++].to_s);
    TakePoses();
    TakeCommands();
  }
  void Offer(LinkPair::End& end, std::size_t channel, std::size_t bytes) {
    end.link->Offer(channel, NumberedMessage(number_, bytes), pair_.now);
    offered_[number_++] = pair_.now;
  }
  void OfferEvents(double s) {
    up_.push_back("up at " + std::to_string(s));
    down_.push_back("down at " + std::to_string(s));
    pair_.onboard.link->Offer(kEventUp, Text(up_.back()), pair_.now);
    pair_.offboard.link->Offer(kEventDown, Text(down_.back()), pair_.now);
  }
  void TakePoses() {
    std::erase_if(pair_.offboard.received, [&](const LinkPair::Received& r) {
      if (r.delivery.channel != kPoseUp) return false;
      if (returned_ && offered_.at(NumberOf(r.delivery.packed)) >= *returned_) {
        result_.slowest_fresh_s = std::max(result_.slowest_fresh_s, Seconds(r.at - *returned_));
        ++result_.returns;
        returned_.reset();
      }
      return true;
    });
  }
  void TakeCommands() {
    std::erase_if(pair_.onboard.received, [&](const LinkPair::Received& r) {
      if (r.delivery.channel != kDriveDown) return false;
      const double age_s = Seconds(r.at - offered_.at(NumberOf(r.delivery.packed)));
      result_.oldest_command_s = std::max(result_.oldest_command_s, age_s);
      ++result_.commands;
      return true;
    });
  }

  std::vector<LineCut> cuts_;
  double seconds_;
  LinkPair pair_;
  Time start_;
  Blackouts result_;
  std::vector<std::string> up_, down_;
  std::map<std::uint32_t, Time> offered_;
  std::uint32_t number_ = 0;
  std::size_t next_cut_ = 0;
  std::optional<Time> returned_;
};

inline Blackouts MeasureBlackouts(std::uint64_t seed, double seconds) {
  return BlackoutRun(seed, seconds).Run();
}

}  // namespace priamos::bus::radio
