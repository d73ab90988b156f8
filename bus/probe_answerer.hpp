#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "bus/clocks/clock.hpp"
#include "bus/host/host_identity.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::bus {

class LcmBus;
class Schema;

/// Answers PROBE, the question of `priamos doctor --probe`, for one process: to the bus, and to the asking
/// socket alone. The second answer also arrives when this host's way to the bus is cut, and says so. Every
/// process of RunProcess has one.
class ProbeAnswerer {
 public:
  /// Most answers in a second, so that a false question cannot make a flood of this process.
  static constexpr int kMostAnswers = 10;

  /// Subscribes to PROBE; answers while `bus` is drained. All of them must outlive it.
  ProbeAnswerer(LcmBus& bus, const Schema& schema, const Clock& clock, std::string process);

  std::uint64_t answers() const { return answers_; }

 private:
  void OnMessage(std::span<const std::byte> bytes);
  bool MayAnswer(Time now);

  LcmBus& bus_;
  const Schema& schema_;
  const Clock& clock_;
  std::string process_;
  HostIdentity host_;
  Time second_{};  ///< begin of the second in which `in_second_` counts
  int in_second_ = 0;
  std::uint64_t answers_ = 0;
};

/// A question or answer of this process on the bus at `url`, all but kind, instance and number.
probe_t MakeProbe(const HostIdentity& host, const std::string& process, const std::string& url, Time now);

}  // namespace priamos::bus
