#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bus/node.hpp"
#include "common/warning_limit.hpp"

namespace priamos {
class ByteStream;
}

namespace priamos::bus {

class OtherBus;

/// Severity of a line of the log; kError needs action by a person.
enum class Level { kInfo, kWarning, kError };
/// State of a process in HEALTH: it works; works with less than it wants; does not work.
enum class Health { kOk, kDegraded, kFailed };

/// Services that an App's host must provide; real time and lockstep do so differently.
struct Surroundings {
  std::string instance;          ///< names this bus on this machine, e.g. for shared memory
  std::string robot;             ///< whose bus it is; empty in lockstep
  std::string config_dir = ".";  ///< relative file names in a configuration start here
  std::uint64_t seed = 0;        ///< for simulated hardware only
  std::int32_t claimant = 0;     ///< instance of this process in its claim; random, 0 in lockstep
  bool lockstep = false;         ///< simulated time: work inline, never in a thread
  bool from_log = false;         ///< what it hears happened long ago
  std::function<void(Level, std::string_view)> log;
  /// Opens a serial port; throws std::runtime_error with one sentence.
  std::function<std::unique_ptr<ByteStream>(const std::string& path, int baud)> open_serial;
  /// Opens the offboard bus of another robot; empty where there is none (lockstep, a log). Throws BusError.
  std::function<std::unique_ptr<OtherBus>(const std::string& robot)> open_bus{};
};

/// Everything an App may ask of the process it lives in.
class Context {
 public:
  Context(Node& node, Surroundings surroundings) : node_(node), around_(std::move(surroundings)) {}

  Node& node() { return node_; }
  const std::string& instance() const { return around_.instance; }
  const std::string& robot() const { return around_.robot; }
  std::uint64_t seed() const { return around_.seed; }
  std::int32_t claimant() const { return around_.claimant; }
  bool lockstep() const { return around_.lockstep; }
  /// Whether it lives on a log: what it finds is of then, and files that are kept for today stay as they are.
  bool from_log() const { return around_.from_log; }
  /// Path of a file: `name` itself when absolute, else below the folder of the configuration file.
  std::string ResolvePath(const std::string& name) const;

  std::unique_ptr<ByteStream> OpenSerial(const std::string& path, int baud);
  /// Opens the offboard bus of another robot, for a process that joins several. Throws BusError.
  std::unique_ptr<OtherBus> OpenBus(const std::string& robot);
  void Log(Level level, std::string_view text) { around_.log(level, text); }
  /// Warns that a message of a channel is not obeyed or not believed. Whoever is wrong is so at his rate: the
  /// first of a channel is told at once, then one a second at most, with how many were left out.
  void LogRefusal(std::string_view channel, std::string_view text);
  /// Tells how many refusals were left out, where it is time; its host asks for it.
  void LogRefusalsLeftOut();

  /// Sets the state that goes into the next HEALTH message; `text` gives the reason if it is not OK.
  void SetHealth(Health health, std::string_view text = "");
  Health health() const { return health_; }
  const std::string& health_text() const { return health_text_; }
  /// Sets who its HEALTH says that it is, where one bus hears several of its kind; else the App's name. At
  /// most 16 bytes are told.
  void SetHealthName(std::string name) { health_name_ = std::move(name); }
  const std::string& health_name() const { return health_name_; }

  /// One line for whoever started the process, where it can be found say; shown by `priamos up` and
  /// systemctl.
  void SetStatus(std::string text) { status_ = std::move(text); }
  const std::string& status() const { return status_; }

  /// Ends the process after this tick.
  void RequestStop(int exit_code = 0) { exit_code_ = exit_code; }
  std::optional<int> exit_code() const { return exit_code_; }

 private:
  Node& node_;
  Surroundings around_;
  Health health_ = Health::kOk;
  std::string health_text_, health_name_;
  std::string status_;
  WarningLimit refusals_;
  std::optional<int> exit_code_;
};

}  // namespace priamos::bus
