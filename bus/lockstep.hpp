#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bus/app_host.hpp"
#include "bus/radio/line/line.hpp"
#include "common/config.hpp"

namespace priamos::bus {

/// Every App of every host in one process, on simulated time: bit-identical from run to run and much faster
/// than real time. Each host has its own `memq://` bus; hosts meet only on simulated serial lines.
///
/// Apps tick in the order they were added; after every tick its bus is drained, so a message arrives at the
/// simulated moment it was sent.
class Lockstep {
 public:
  using Tap = std::function<void(std::string_view bus, Time now, std::string_view channel,
                                 std::span<const std::byte>)>;

  /// What a run starts from: seed of all random sources, first instant of the simulated clock, log.
  struct Options {
    std::uint64_t seed = 0;
    Time start = FromUtime(1'000'000'000);
    std::function<void(Time, std::string_view process, Level, std::string_view text)>
        log{};  ///< none: silent
  };

  Lockstep(const Schema& schema, Options options);
  ~Lockstep();

  /// Adds the bus of one host; `name` identifies it for taps and AddApp.
  void AddBus(const std::string& name);
  /// Adds a serial line, whose ends Apps open by these names; each direction is a Line of its own.
  void AddSerialLine(const std::string& end_a, const std::string& end_b, const radio::LineConfig& config);
  /// Starts an App on a bus; throws what its start throws. It ticks `phase` [less than its period] after now.
  void AddApp(const AppFactory& factory, const std::string& bus, const ConfigSource& source,
              Duration phase = {});
  /// Removes an App as if it had been killed; AddApp starts it again. Not to be called while an App ticks.
  void RemoveApp(const std::string& name, const std::string& bus);
  /// Sets the function that gets every message on every bus, in order.
  void SetTap(Tap tap) { tap_ = std::move(tap); }
  /// One end of a line, for the driver of the scenario. Throws std::runtime_error for an unknown name.
  std::unique_ptr<ByteStream> OpenSerial(const std::string& name);
  /// A node for the driver of the scenario, e.g. to publish an order.
  Node& DriverNode(const std::string& bus);

  Time now() const { return clock_.Now(); }
  /// The exit code of the first App that asked to stop; 0 when none did.
  int exit_code() const;
  /// Runs until `until`, or until `done()` (asked after every step) is true. Returns whether it was done; an
  /// App that asks to stop ends the run as well.
  bool RunUntil(Time until, const std::function<bool()>& done = {});

 private:
  struct Host;
  struct Wire;
  class SerialEnd;

  Host& HostOf(const std::string& bus);
  Surroundings SurroundingsOf(const AppFactory& factory, const Host& host, const ConfigSource& source);
  Time NextTick() const;
  void StepAll();

  const Schema& schema_;
  Options options_;
  SimulatedClock clock_;
  Tap tap_;
  std::vector<std::unique_ptr<Host>> hosts_;
  std::vector<std::shared_ptr<Wire>> wires_;
  struct Member {
    std::unique_ptr<AppHost> app;
    Host* host;
  };
  std::vector<Member> members_;
  std::vector<std::unique_ptr<AppHost>> buried_;
};

}  // namespace priamos::bus
