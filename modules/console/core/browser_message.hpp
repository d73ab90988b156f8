#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "common/geometry.hpp"
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

/// A place on the plan, map frame.
struct Target {
  Pose2 map_from_base;
  bool turn = true;  ///< the heading counts
};

/// An order to the planner.
struct MissionOrder {
  /// What the planner is to do.
  enum class Kind { kAbort, kPassDoor, kGoto };
  Kind kind = Kind::kAbort;
  int landmark_id = 0;  ///< door to pass
  Target goal{};        ///< place to drive to
};

/// A person says where the robot stands.
struct PlaceOrder {
  Pose2 map_from_base;
};

/// The page shows, or no longer shows, a channel that the radio carries only on request.
struct ListenWish {
  std::string channel;
  bool on = false;
};

/// A parameter of a running process is to be read or changed.
struct ParameterWish {
  /// What is to be done with it.
  enum class Kind { kRead, kSet, kSave, kReset };
  Kind kind = Kind::kRead;
  std::string process, key;  ///< no key: none in particular
  double value = 0;          ///< kSet
};

/// Something is ordered of whoever supervises a process.
struct ProcessWish {
  /// What is to be done: a process started again, lines of its console told, the simulation begun anew.
  enum class Kind { kRestart, kLog, kNewWorld };
  Kind kind = Kind::kLog;
  std::string name;            ///< of the process; kNewWorld: of the scenario
  std::int64_t end_bytes = 0;  ///< kLog: where in the console the lines end; 0: at its end
};

/// Speeds at which a log can be shown, times its own.
inline constexpr double kSlowestReplay = 0.1, kFastestReplay = 32;

/// How a log is to be shown on.
struct ReplayOrder {
  /// What becomes of the playback.
  enum class Kind { kPlay, kPause, kStep, kSeek, kSpeed };
  Kind kind = Kind::kPlay;
  double value = 0;  ///< kSeek: [s] since the log's beginning; kSpeed: times its own speed
};

/// One message of a page.
using BrowserMessage = std::variant<StickReport, StopOrder, MissionOrder, PlaceOrder, ListenWish,
                                    ParameterWish, ProcessWish, ReplayOrder>;

/// Reads one message: JSON, UTF-8, at most kMaxBrowserMessage bytes, with the keys of README.md and no other.
/// Numbers out of range, NaN among them, are refused, not clipped.
Outcome<BrowserMessage> ReadBrowserMessage(std::string_view text);

}  // namespace priamos::console
