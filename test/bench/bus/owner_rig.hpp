#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/clocks/clock.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "lcmtypes/channels.hpp"
#include "test/bench/bus/owner_networks.hpp"

namespace priamos::bench {

struct OwnerRigOptions {
  std::string program_folder, source_folder, run_folder;
  std::uint64_t seed = 1;
};

/// What was seen of the wheels since Forget(): by the commands on the wire and by what the wheels did.
struct WheelWatch {
  std::set<std::int32_t> instances;  ///< that commanded
  Duration two_obeyed{};             ///< longest time in which two commanded and the wheels were not held
  std::optional<Time> second;        ///< first command of the second instance
  std::optional<Duration> stood;     ///< so long after `second`, or after Mark(), the base stood
  bool contested = false;
  int alarms = 0;
};

/// A drive board (`world` on an open field), an operator who turns the base on the spot and never lets go,
/// and `robot` processes that come and go on two computers.
class OwnerRig {
 public:
  explicit OwnerRig(const OwnerRigOptions& options);

  std::unique_ptr<Program> StartRobot(TwoNetworks::Side side = TwoNetworks::Side::kLeft);
  /// Goes on until `done`, at most `most`; returns whether it was done.
  bool Until(const std::function<bool()>& done, Duration most);
  void Wait(Duration duration);
  Time Now() const { return clock_.Now(); }

  /// The instance whose commands the board obeys now; nullopt while it holds the wheels.
  std::optional<std::int32_t> Obeyed() const;
  /// The base turns, by command of the process.
  bool Drives(const Program& robot) const;
  /// Whether the process says on the bus of a side that it holds its role.
  bool Holds(TwoNetworks::Side side, const Program& robot) const;

  /// Whether it commands wheels there, be there a board or not.
  bool Commands(TwoNetworks::Side side, const Program& robot) const;

  void Forget();
  /// From now on the base is expected to stand.
  void Mark();

  TwoNetworks networks;
  WheelWatch watch;

 private:
  struct Side;
  struct Operator;
  Side& Of(TwoNetworks::Side side) const;
  void Step();
  void Watch();
  void WatchCommands();
  void WatchState(const wheel_state_t& state);

  OwnerRigOptions options_;
  bus::Schema schema_;
  bus::MonotonicClock clock_;
  std::vector<std::shared_ptr<Side>> sides_;
  std::unique_ptr<Program> world_;
  wheel_state_t state_{};
  Time state_at_{};
  std::optional<Time> two_since_, expected_;
  double turn_rad_s_ = 0, turn_before_rad_s_ = 0;
  int programs_ = 0;
};

}  // namespace priamos::bench
