#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/radio/link.hpp"
#include "common/random.hpp"
#include "test/bus/radio/explorer/powered_store.hpp"
#include "test/bus/radio/explorer/promises.hpp"

/// Two link ends in a small world of a few seconds, in which exactly those accidents happen that are named:
/// what an exhaustive search over all worlds of one and two accidents is made of.
namespace priamos::bus::radio {

/// What becomes of a frame on the line, or of an end of the link.
enum class Accident {
  kLost,           ///< the frame never arrives
  kTwice,          ///< it arrives again 0.3 s later, as a repeater or an attacker would have it
  kLate,           ///< it, and on a serial line all behind it, arrives 60 ms later
  kVeryLate,       ///< the same with 0.7 s
  kKilled,         ///< the process ends without a warning and is started again
  kStopped,        ///< it ends in order and is started again
  kPowerLost,      ///< the machine is started again with what the disk held
  kPowerLostLate,  ///< the same, with what was just being written
  kEmptied,        ///< it is started with an empty disk
  kPutBack,        ///< it is started with an older state that somebody kept, which the store notices
  kDiskFull        ///< nothing can be written for 0.25 s, after which the process is killed and started again
};
inline constexpr Accident kFrameAccidents[] = {Accident::kLost, Accident::kTwice, Accident::kLate,
                                               Accident::kVeryLate};
inline constexpr Accident kEndAccidents[] = {
    Accident::kKilled,  Accident::kStopped, Accident::kPowerLost, Accident::kPowerLostLate,
    Accident::kEmptied, Accident::kPutBack, Accident::kDiskFull};

/// A place in a run at which an accident can happen.
enum class PlaceKind { kFrame, kEnd };

/// An accident at a place; places are numbered in the order of time.
struct Mishap {
  std::size_t place = 0;
  Accident accident = Accident::kLost;
};

/// The world that is explored.
struct ExploredWorld {
  bool datagrams = false;             ///< a network that reorders, not a serial line
  Duration packet_overhead{};         ///< with datagrams: packets of a radio, with so much time on air beside
  Duration end_places_every{20'000};  ///< distance of the places at which an end can fail
  bool rekey = false;  ///< the offboard end begins with a next key, the onboard end is started again with it
};

/// One run: 0.4 s of agreement, 1.2 s in which things are offered and accidents happen, and 4 s to recover.
class ExploredRun {
 public:
  ExploredRun(ExploredWorld world, std::vector<Mishap> mishaps);

  /// Runs to the end; returns the promises that were broken, as sentences.
  std::vector<std::string> Run();
  /// The places that the run had.
  const std::vector<PlaceKind>& places() const { return places_; }

 private:
  struct End {
    Direction outgoing;
    PoweredStore store{};
    std::optional<LinkKey> next_key{};
    std::unique_ptr<LinkEndpoint> link{};
    std::vector<std::byte> frame{};  ///< what has left of the frame that is being sent
    std::multimap<Time, std::vector<std::byte>> arriving{};
    Time last_arrival{};
    std::optional<Time> full_until{};
  };
  const Accident* AccidentHere(PlaceKind kind);
  bool Exploring() const;
  void Start(End& end);
  void Fail(End& end, Accident accident);
  void FreeDisk(End& end);
  void Tick();
  void Offer();
  void OfferTo(End& end, std::size_t channel, std::size_t size);
  void Send(End& from, End& to);
  void EndFrame(End& from, End& to);
  void Receive(End& end);
  std::vector<Delivery> Take(LinkEndpoint& link, std::span<const std::byte> frame) const;

  ExploredWorld world_;
  std::vector<Mishap> mishaps_;
  std::vector<PlaceKind> places_;
  Time start_, now_;
  Rng nonces_;
  Promises promises_;
  End onboard_{Direction::kUp}, offboard_{Direction::kDown};
};

}  // namespace priamos::bus::radio
