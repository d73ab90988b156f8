#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "bus/radio/frame/frame.hpp"
#include "common/time.hpp"

namespace priamos::bus::radio {

/// Source of fresh random numbers: unpredictable on a robot, seeded in a simulation.
using NonceSource = std::function<std::uint64_t()>;

/// A random number that says when it was drawn: 28 bits of the second of `now`, before 36 of `random`. Who
/// records hellos can only replay earlier ones: of those who ask, the latest is the other end, where clocks
/// are right.
std::uint64_t TimedNonce(std::uint64_t random, Time now);

/// The last random numbers that something was noted of. Who records hellos has one per start of the end that
/// said them: more than are remembered would look new again when he replays them.
class LastNonces {
 public:
  bool Has(std::uint64_t nonce) const { return std::find(all_.begin(), all_.end(), nonce) != all_.end(); }
  void Add(std::uint64_t nonce) {
    if (!Has(nonce)) all_[next_++ % all_.size()] = nonce;
  }

 private:
  std::array<std::uint64_t, 256> all_{};
  std::size_t next_ = 0;
};

/// Those who ask for an answer: one of them at most is the other end, the rest are replays of its earlier
/// lives. The one that was drawn last by its time gets every second answer. The other half is for an end
/// without a right clock: none that was answered comes before one that was not.
class Askers {
 public:
  bool any() const { return newest_.has_value(); }
  /// Notes one; false when others come before it.
  bool Add(std::uint64_t nonce);
  /// Who is answered next; it counts as answered.
  std::uint64_t Take();
  /// Forgets them: data of the epoch in use came, so that those answered are not the other end.
  void Refute();
  /// Forgets them, because the other end is found.
  void Clear();
  /// Whether data came after an answer to it.
  bool Refuted(std::uint64_t nonce) const { return refuted_.Has(nonce); }

 private:
  std::optional<std::uint64_t> newest_;  ///< came last
  std::uint64_t drawn_last_ = 0;         ///< by the time in it
  bool by_time_ = true;                  ///< the next answer is for `drawn_last_`
  LastNonces answered_, refuted_;
};

/// Agreement on an epoch after an end has lost its state. Counters protect against old frames only while
/// both ends remember them; an end that has forgotten asks for a new epoch, whose name is made of a fresh
/// random number of each end. No frame of any earlier epoch passes in it, so neither end needs to remember
/// anything. Three hello frames, about 0.12 s at 9600 baud; both ends that kept their state need none.
///
/// Why an old hello does no harm: only a hello that echoes the random number drawn last here, before that
/// number has proven another one, is fresh, and nothing but a fresh hello changes what is agreed. A replayed
/// one therefore costs an answer (which the link limits in rate) and nothing else.
class EpochAgreement {
 public:
  /// The random numbers that an epoch is made of, one drawn by each end.
  struct Pair {
    std::uint64_t own = 0;
    std::uint64_t peer = 0;
  };
  /// What follows from a hello.
  struct Change {
    std::optional<Pair> agreed{};  ///< change to the epoch of this pair now
    bool fresh = false;            ///< it was made after the number that it echoes, and came the first time
    bool known = false;            ///< it comes from the end that the epoch was agreed with
    bool reply = false;            ///< send Compose() soon
  };

  explicit EpochAgreement(NonceSource nonces);

  /// Takes a hello. `same_table`: its sender has the channel table of this end; else there is nothing to
  /// agree on, and the exchange only proves that the hello is fresh. `heard`: the other end's data comes, so
  /// that what asked before it is not the other end and gets no second answer.
  Change OnHello(const Hello& hello, bool same_table = true, bool heard = false);
  /// Notes a data frame in the epoch in use: who asked before it is not the other end.
  void OnData();
  /// The next hello to send, table hash and stream left to the caller. It answers whoever asks, or ends the
  /// agreement.
  Hello Compose(bool need);

 private:
  Change Prove(const Hello& hello, bool same_table);
  void DrawIfUsed();

  NonceSource nonces_;
  std::uint64_t own_;
  bool used_ = false;           ///< own_ has proven a hello: it proves no other
  std::optional<Pair> agreed_;  ///< of the epoch in use, when it was agreed on in this life
  bool confirmed_ = false;      ///< data of it has come
  bool owes_last_ = false;      ///< the other end waits for the hello that ends the agreement
  bool answered_last_ = true;   ///< the last hello was another one
  Askers asking_;               ///< since; not proven
};

}  // namespace priamos::bus::radio
