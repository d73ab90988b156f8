#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "common/outcome.hpp"
#include "common/pilot/stick.hpp"

namespace priamos::console {

/// Longest message of a browser [byte].
inline constexpr std::size_t kMaxBrowserMessage = 512;

/// What the hand at a page does now; repeated while it does anything.
struct StickReport {
  std::int64_t beat = 0;             ///< newest beat that the page had received
  std::array<double, kAxes> axis{};  ///< -1..1, order of kAxisNames
  bool hold = false;                 ///< the dead-man
  bool rearm = false, take_over = false, mode = false, range = false;  ///< buttons that are pressed
};

/// The emergency stop, from anybody and in any state.
struct StopOrder {};

/// An order to the planner.
struct MissionOrder {
  bool abort = false;
  int landmark_id = 0;  ///< door to pass
};

/// The page shows, or no longer shows, a channel that the radio carries only on request.
struct ListenWish {
  std::string channel;
  bool on = false;
};

/// One message of a page.
using BrowserMessage = std::variant<StickReport, StopOrder, MissionOrder, ListenWish>;

/// Reads one message: JSON, UTF-8, at most kMaxBrowserMessage bytes, with the keys of README.md and no other.
/// Numbers out of range, NaN among them, are refused, not clipped.
Outcome<BrowserMessage> ReadBrowserMessage(std::string_view text);

}  // namespace priamos::console
