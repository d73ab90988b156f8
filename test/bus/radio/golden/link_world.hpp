#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bus/radio/line/line.hpp"
#include "bus/radio/link.hpp"
#include "common/random.hpp"
#include "link_trace.hpp"

/// Two link ends in seeded worlds, and a digest of everything that they do: what a change of the inside must
/// leave as it is.
namespace priamos::bus::radio {

/// What happens to two ends; rates are means of random times.
struct World {
  LineConfig line{.latency_s = 0.005};
  LinkOptions options{};
  double load = 1;               ///< messages offered, relative to the rates of the channels
  double stops_hz = 0.5;         ///< messages of urgent channels, each
  double frame_loss = 0;         ///< probability that a frame is lost as a whole
  double datagram_jitter_s = 0;  ///< with `options.datagrams`: largest addition to the latency
  double restarts_hz = 0;        ///< of each end
  double forgets = 0;            ///< share of the restarts that find the memory empty
  double rollbacks = 0;          ///< share of the restarts that find an older memory
  double orderly = 0;            ///< share of the restarts after Close()
  double hostile_hz = 0;         ///< replayed, damaged, reflected, spliced and random frames at each end
  double insider_hz = 0;         ///< frames with a right code and nonsense inside, at each end
  double stalls_hz = 0;          ///< times at which nobody calls for 20 to 300 ms
  bool encrypted = false;
  bool tables_differ = false;
  bool keys_differ = false;
  double seconds = 30;
};

/// One direction of the line, or of a network that reorders and doubles datagrams.
class Path {
 public:
  Path(const World& world, Line& line, Rng rng) : world_(world), line_(line), rng_(std::move(rng)) {}
  void Write(std::span<const std::byte> bytes, Time now);
  std::vector<std::byte> Read(Time now);
  /// Frames that were sent, the last ones.
  const std::deque<std::vector<std::byte>>& frames() const { return frames_; }

 private:
  void EndFrame(Time now);

  const World& world_;
  Line& line_;
  Rng rng_;
  std::vector<std::byte> frame_;
  bool lost_ = false;
  std::multimap<Time, std::vector<std::byte>> datagrams_;
  std::deque<std::vector<std::byte>> frames_;
};

/// Runs one world.
class WorldRun {
 public:
  WorldRun(const World& world, std::uint64_t seed);
  WorldRun(const WorldRun&) = delete;
  WorldRun& operator=(const WorldRun&) = delete;

  void Run();
  std::uint64_t digest() const { return trace_.digest(); }
  /// Messages delivered per channel class, so that a test knows that its world is alive.
  const std::map<ChannelClass, std::uint64_t>& delivered() const { return delivered_; }

 private:
  struct End {
    Direction outgoing;
    TracedStore store;
    std::unique_ptr<LinkEndpoint> link{};
    std::uint64_t walk = 0;  ///< slowly changing values of states with differences
  };
  End& Other(const End& end) { return &end == &onboard_ ? offboard_ : onboard_; }
  void Start(End& end);
  void Restart(End& end);
  void Tick();
  void Offer(End& end);
  std::vector<std::byte> Message(End& end, const LinkChannel& channel);
  void Listen(End& end);
  void Move(End& end, Path& path);
  void Take(End& end, std::span<const std::byte> bytes);
  std::vector<std::byte> Forged(const End& end);
  std::vector<std::byte> Nonsense(End& sender);
  void Note(const End& end);
  bool Happens(Rng& rng, double rate_hz) { return rng.Chance(rate_hz * Seconds(step_)); }

  World world_;
  Time now_;
  Duration step_{1000};
  Trace trace_;
  Rng offers_, accidents_, attacks_, nonces_;
  LinePair lines_;
  Path up_, down_;
  End onboard_, offboard_;
  std::map<ChannelClass, std::uint64_t> delivered_;
};

}  // namespace priamos::bus::radio
