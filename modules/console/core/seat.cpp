#include "console/core/seat.hpp"

#include <algorithm>
#include <utility>

namespace priamos::console {
namespace {

/// Whether the hand does what can move the robot.
bool Moves(const StickReport& report) {
  return report.hold || std::any_of(report.axis.begin(), report.axis.end(), [](double v) { return v != 0; });
}

bool IsBusy(const StickReport& report) {
  return Moves(report) || report.rearm || report.take_over || report.mode || report.range;
}

std::uint32_t Bit(bool pressed, int button) {
  return pressed && button >= 0 && button < 32 ? 1u << button : 0;
}

}  // namespace

void Seat::Leave(ClientId client) {
  pages_.erase(client);
  if (holder_ == client) Free();
}

bool Seat::Take(ClientId client, const StickReport& report, Duration age, Time now) {
  if (age > freshness_) return false;
  const auto page = pages_.find(client);
  if (page == pages_.end()) return true;
  if (!Moves(report)) page->second.has_let_go = true;
  if (!page->second.has_let_go) return true;
  if (holder_ != client) {
    if (!IsBusy(report) || !MayTakeOver(report)) return true;
    Free();
    holder_ = client;
    page->second.has_let_go = !report.take_over || !Moves(report);
    if (!page->second.has_let_go) return true;
  }
  report_ = report;
  // The pilot stops for a stick that was not heard for `silence`: for one that is older than `freshness` as
  // well.
  heard_ = std::min(now, now - age + freshness_ - silence_);
  if (IsBusy(report)) busy_ = now;
  presses_ |= Pressed(report);
  return true;
}

void Seat::End() {
  for (auto& [client, page] : pages_) page.has_let_go = false;
  Free();
}

/// The pilot must not take the next hand for the one before: unless that rested, it sees no stick in between.
void Seat::Free() {
  if (holder_ && IsBusy(report_)) hidden_ = true;
  holder_.reset();
  report_ = {};
  presses_ = 0;
}

std::uint32_t Seat::Held(const StickReport& report) const {
  return Bit(report.hold, buttons_.dead_man) | Bit(report.rearm, buttons_.rearm);
}

std::uint32_t Seat::Pressed(const StickReport& report) const {
  return Bit(report.take_over, buttons_.take_over) | Bit(report.mode, buttons_.mode) |
         Bit(report.range, buttons_.range);
}

Stick Seat::Look(Time now) {
  if (holder_ && IsBusy(report_) && now - heard_ > kSilence) {
    pages_[*holder_].has_let_go = false;
    Free();
  }
  if (holder_ && now - busy_ > kRelease) Free();
  Stick stick;
  stick.connected = !pages_.empty() && !std::exchange(hidden_, false);
  if (!stick.connected || !holder_) return stick;
  stick.heard = heard_;
  stick.axis = report_.axis;
  stick.buttons = Held(report_) | Pressed(report_) | std::exchange(presses_, 0);
  return stick;
}

}  // namespace priamos::console
