#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/time.hpp"

namespace priamos::bus {

/// A process that wants, or has, one role of one robot on one bus.
struct Claimant {
  std::string robot, role;
  std::int32_t instance = 0;  ///< drawn at random when the process starts
  std::string host;
  int pid = 0;
};

/// What a claimant reports of itself.
struct ClaimWord {
  Claimant who;
  bool holds = false;  ///< has the role; otherwise asks for it
  Duration age{};      ///< since it asked, by its own monotonic clock; frozen while it hears a rival
};

/// The claim of one process as a state machine: asks, and when nobody better answers holds the role and
/// reports it five times a second. Time is an argument; it is this process's own monotonic clock, and nothing
/// of another clock is ever compared but durations.
///
/// Two claimants compare their messages: who holds goes before who asks, then the greater age, then the
/// greater instance. The lesser one gives up: refused while it asked, yielded while it held. The
/// rank that a claimant reports never decreases, so whoever gives up leaves a better one behind: there is
/// always a survivor. An age stands still from the first message of a rival on, so that both compare the same
/// two numbers whatever the delay of their messages: there is only one survivor.
///
/// The last message of a process that was just killed may still be in transit: who asks gives up only when a
/// holder is heard again kConfirm later, and asks on until nothing was heard of it for kAskFor.
///
/// A process that stood still for kLapse may have lost its role to a process that asked meanwhile: it begins
/// anew at age 0, and messages that arrived meanwhile must be thrown away (see Touch).
class Claim {
 public:
  /// How far the claim has come; kRefused (while it asked) and kYielded (while it held) are final.
  enum class State { kAsking, kHeld, kRefused, kYielded };

  static constexpr Duration kAskFor{200'000};
  static constexpr Duration kAskAgain{40'000};
  static constexpr Duration kConfirm{20'000};
  static constexpr Duration kAnnounce{200'000};
  static constexpr Duration kLapse{1'000'000};
  /// Silence after which a rival counts as gone, and the age increases again.
  static constexpr Duration kForget{2'000'000};
  /// Shortest time between two answers to others.
  static constexpr Duration kAnswer{10'000};

  /// Asks from `now` on, for `ask_for`.
  Claim(Claimant self, Time now, Duration ask_for = kAskFor);

  /// Notes that the process runs; called at every turn, before it takes messages. Returns true when it stood
  /// still for kLapse: everything that came meanwhile is out of date and has to be thrown away.
  bool Touch(Time now);
  /// Takes a claimant's message; the process's own ones come back from the bus and are not counted.
  void Hear(const ClaimWord& word, Time now);
  /// The message that is to be sent now, if any; asking ends here.
  std::optional<ClaimWord> Step(Time now);
  /// Time at which Step is to be called next, unless a message arrives before.
  Time next_step() const { return say_at_; }

  State state() const { return state_; }
  const Claimant& self() const { return self_; }
  /// The claimant that refused this one, or made it yield.
  const std::optional<ClaimWord>& winner() const { return winner_; }
  /// A process that held the same role and has to yield; each is returned once.
  std::optional<ClaimWord> TakeLoser();

 private:
  bool IsRival(const Claimant& other) const;
  bool Outranks(const ClaimWord& word, Time now) const;
  Duration Age(Time now) const;
  bool IsConfirmed(Time now);
  void Meet(const ClaimWord& word, Time now);
  ClaimWord Word(Time now) const;

  Claimant self_;
  Duration ask_for_;
  State state_ = State::kAsking;
  Time begin_, ask_until_, active_, say_at_;
  std::optional<Time> said_, rival_heard_, holder_heard_;
  Duration frozen_{};  ///< age while a rival is heard
  std::optional<ClaimWord> winner_, loser_;
  std::optional<std::int32_t> reported_loser_;
};

}  // namespace priamos::bus
