#pragma once

#include <cstdint>
#include <optional>

#include "bus/radio/frame/epoch.hpp"
#include "bus/radio/frame/frame.hpp"
#include "bus/radio/line/link_quality.hpp"
#include "common/time.hpp"

namespace priamos::bus::radio {

/// How well this end can use what the other one sends.
enum class Reception : std::uint8_t {
  kHeard,    ///< data frames are accepted
  kSilent,   ///< nothing was accepted of late
  kUnusable  ///< frames come and cannot be used, or there is no epoch
};

/// What is exchanged until both ends use the same channel table, epoch and counters: hellos, and the floor.
/// It decides when a hello is sent; epoch.hpp defines what it means.
class Handshake {
 public:
  /// Handshake that begins now. `floor_due`: this end's memory of accepted counters was reserved ahead, so
  /// that the other end may still send counters that count as used here.
  Handshake(std::uint32_t table_hash, NonceSource nonces, bool floor_due, Time now,
            std::size_t code_bytes = kShortCodeBytes);

  /// What a hello proves.
  struct Proof {
    bool fresh = false;                            ///< no replay: what it says may be believed
    std::optional<EpochAgreement::Pair> agreed{};  ///< the nonces whose epoch is to be used from now on
  };
  /// Takes a hello. One that is not fresh is at most answered. `heard`: data frames are accepted of late.
  Proof OnHello(const Hello& hello, bool heard = false);
  /// Notes that a data frame was accepted: both ends use the same table, epoch and counters.
  void OnData();
  /// Notes that this end uses a new epoch.
  void OnEpochChanged();

  /// Whether a hello is to be sent now. Hellos that an attacker can provoke are limited in rate.
  bool HelloDue(Reception reception, Time now) const;
  /// The hello; it counts as sent. `stream` names this end's numbering of events.
  Hello Take(std::uint32_t stream, Reception reception, Time now);
  /// Makes the hello due again, because its frame was cut off.
  void Return() { reply_due_ = true; }
  /// The hello has left whole.
  void OnSent() { ++sent_; }

  /// Whether a FloorEntry is to be sent: the counters that the other end must skip.
  bool floor_due() const { return floor_due_; }
  /// Whether the next turn is that of a frame with a FloorEntry, as a hello had the last one. Where urgent
  /// events leave few turns, the one would keep the other back for ever.
  bool floor_waits() const { return floor_waits_; }
  /// Notes that a FloorEntry is sent.
  void OnFloorSent() { floor_waits_ = false; }
  /// Whether the other end's last fresh hello had another channel table.
  bool table_mismatch() const { return table_mismatch_; }
  /// Length of the other end's codes by its last hello; 0 before. Another one than here is a table mismatch.
  std::size_t peer_code_bytes() const { return peer_code_bytes_; }
  /// Time of the last hello from here.
  Time last() const { return last_; }
  /// Goes on with the counters of the handshake that this one replaces.
  void CountOn(const Handshake& before);
  std::uint64_t received() const { return received_; }
  std::uint64_t sent() const { return sent_; }

 private:
  std::uint32_t table_hash_;
  std::size_t code_bytes_;
  EpochAgreement agreement_;
  AnswerLimit limit_;
  Time last_;  ///< time of the last hello from here
  bool reply_due_ = false;
  bool switched_ = false;  ///< this end uses a new epoch, of which no frame has come yet
  bool floor_due_;
  bool floor_waits_ = false;
  bool table_mismatch_ = false;
  std::size_t peer_code_bytes_ = 0;
  std::uint64_t received_ = 0;
  std::uint64_t sent_ = 0;
};

}  // namespace priamos::bus::radio
