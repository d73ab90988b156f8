#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "bus/claim.hpp"
#include "bus/clocks/clock.hpp"
#include "bus/context.hpp"
#include "bus/sole_speaker.hpp"
#include "bus/wire/udp_receiver.hpp"

namespace priamos::bus {

class LcmBus;
class Schema;

/// Exclusive rights that a process claims besides its role.
struct ClaimTerms {
  std::vector<std::string> speaks_alone;  ///< channels on which nobody else may send
  /// How long it asks, and listens for other senders on them: the slowest device channel comes ten times a
  /// second and is stale after half a second.
  Duration ask_for = speaks_alone.empty() ? Claim::kAskFor : Duration(500'000);
};

/// Wakes a thread that polls it, from another thread.
class Signal {
 public:
  Signal();
  ~Signal();
  Signal(const Signal&) = delete;
  Signal& operator=(const Signal&) = delete;

  /// File descriptor that is readable from Set() on.
  int fd() const { return fd_; }
  void Set() const;

 private:
  int fd_;
};

/// Keeps the claim of this process on a UDP multicast bus: asks when it is made, then answers in a thread of
/// its own, because a tick may take long and a process that asks waits only 200 ms.
class ClaimKeeper {
 public:
  using Log = std::function<void(Level, std::string_view)>;

  /// Takes terms.ask_for. Throws BusError with one sentence that names the owner, when there is one. `bus`,
  /// `schema` and `clock` must outlive the keeper; `bus` sends for it, from the keeper's thread as well.
  ClaimKeeper(LcmBus& bus, const Schema& schema, const Clock& clock, const Claimant& self,
              const ClaimTerms& terms, Log log);
  ~ClaimKeeper();
  ClaimKeeper(const ClaimKeeper&) = delete;
  ClaimKeeper& operator=(const ClaimKeeper&) = delete;

  /// File descriptor that becomes readable when the role is lost; ALARM has been sent by then.
  int fd() const { return lost_.fd(); }
  /// Why it is lost, one sentence with the next step; nullopt while it is held.
  std::optional<std::string> lost() const;
  /// Holders of other roles on this bus, heard while this one asked.
  const std::vector<ClaimWord>& others() const { return others_; }

 private:
  void Ask();
  void Run();
  void Wait();
  void Listen();
  void OnMessage(std::uint64_t sender, std::string_view channel, std::span<const std::byte> bytes);
  void OnClaim(std::uint64_t sender, std::span<const std::byte> bytes);
  void Say();
  std::string WhyRefused() const;
  std::string WhyForeign(const SoleSpeaker::Intruder& intruder) const;
  void Alarm(int severity, const std::string& text);
  bool ReportLoss();
  void Lose(const std::string& why);

  LcmBus& bus_;
  const Schema& schema_;
  const Clock& clock_;
  Log log_;
  UdpReceiver receiver_;
  Claim claim_;
  SoleSpeaker alone_;
  std::vector<ClaimWord> others_;
  Signal lost_, stop_;
  mutable std::mutex mutex_;  ///< guards why_lost_
  std::optional<std::string> why_lost_;
  std::thread thread_;
};

}  // namespace priamos::bus
