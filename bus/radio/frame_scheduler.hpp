#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bus/radio/channels/age_bound.hpp"
#include "bus/radio/frame_length.hpp"
#include "bus/radio/frame_receiver.hpp"
#include "bus/radio/line/repetition.hpp"
#include "bus/radio/line/turn_taking.hpp"
#include "bus/radio/link_memory.hpp"
#include "bus/radio/message_receiver.hpp"
#include "bus/radio/message_sender.hpp"
#include "bus/radio/peer.hpp"
#include "bus/radio/transmitter.hpp"

namespace priamos::bus::radio {

/// The parts of an end that put entries into a frame.
struct FrameSources {
  LinkMemory& memory;
  const FrameReceiver& receiver;
  Peer& peer;
  MessageReceiver& inbox;
  MessageSender& outbox;
};

/// Counters of the frames that were sent.
struct SendCounters {
  std::uint64_t frames = 0;        ///< data frames that left whole
  std::uint64_t aborted = 0;       ///< frames cut off by an urgent message
  std::uint64_t bundle_bytes = 0;  ///< bytes of the bundles of these frames
};

/// What a frame is for. Where turns are one frame, no kind may take all of them.
enum class FrameKind { kHello, kUrgent, kMixed };

/// The frame that is being sent: what must be noted when it has left, or undone when it is cut off.
struct FrameInFlight {
  std::uint64_t counter = 0;  ///< 0: a hello
  bool urgent = false;        ///< never cut off
  bool repeats = false;       ///< repetitions and acknowledgements of urgent events: cut off by a new one
  bool over = false;          ///< ends the turn
  bool next_key = false;      ///< a hello under the next key
  std::size_t bundle_bytes = 0;
  std::optional<AgeBound::First> first{};
  Peer::Loaded peer{};
  MessageReceiver::Loaded inbox{};
  MessageSender::Loaded outbox{};
};

/// Which frame goes next, when its bytes may leave, and when it is cut off for an urgent message.
class FrameScheduler {
 public:
  /// Scheduler without a frame; `table` must outlive it and its copies.
  FrameScheduler(const ChannelTable& table, const FrameSealer& sealer, const LinkOptions& options,
                 bool onboard, Time now);

  /// The bytes that may be written to the line now.
  std::vector<std::byte> Step(FrameSources from, Time now);
  /// Notes that what had arrived by `now` was read.
  void OnLook(Time now) { turns_.OnLook(now); }
  /// Notes the time at which bytes came, of whomever.
  void OnBytes(Time now) { turns_.OnBytes(now); }
  /// Notes the time at which a frame came that the other end has just sent.
  void OnFrame(Time now) { turns_.OnFrame(now); }
  /// Notes that the other end announced the end of its turn (half-duplex).
  void OnOver(Time now) { turns_.OnOverReceived(now); }
  /// The turns of this end, which the station of a shared channel grants.
  TurnTaking& turns() { return turns_; }
  const TurnTaking& turns() const { return turns_; }
  /// When the bytes handed over have left.
  Time line_free() const { return transmitter_.pacer().free_at(); }

  /// Seals from now on under another key.
  void SetSealer(const FrameSealer& sealer) { sealer_ = sealer; }

  /// Time that bytes of a frame take on the line.
  Duration OnTheWay(std::size_t bytes) const { return transmitter_.OnTheWay(bytes); }
  const SendCounters& counters() const { return counters_; }
  std::uint64_t bytes_sent() const { return transmitter_.bytes_sent(); }

 private:
  void ChooseForm(const FrameSources& from, Time now);
  bool MustCut(const FrameSources& from, Time now) const;
  bool MaySend(const FrameSources& from, Time now) const;
  bool Build(FrameSources from, Time now);
  bool BuildHandshake(FrameSources from, Time now);
  bool BuildUrgent(FrameSources from, Time now);
  bool BuildOther(FrameSources from, Time now);
  bool AckAgain(const FrameSources& from, Time now) const;
  LineCode LineCodeOf(const FrameSources& from, Time now) const;
  bool DataDue(const FrameSources& from, Time now) const;
  bool BuildAnyHello(FrameSources from, Time now);
  void BuildHello(FrameSources from, Handshake& handshake, const FrameSealer& sealer, Reception reception,
                  Time now);
  bool BuildData(FrameSources from, bool urgent_only, Time now);
  BundleBuilder NewBundle(const FrameSources& from, bool urgent_only, LineCode line_code, Time now) const;
  std::size_t TargetBytes(const FrameSources& from, LineCode line_code, Time now) const;
  std::optional<AgeBound::First> ChooseFirst(const BundleBuilder& bundle, const FrameSources& from,
                                             Time now) const;
  std::size_t FrameBytes(std::size_t bundle_bytes) const;
  std::size_t BytesBy(Time end, Time now) const;
  FrameInFlight Fill(BundleBuilder& bundle, FrameSources from, bool urgent_only, LineCode line_code,
                     Time now) const;
  void LoadControl(BundleBuilder& bundle, FrameSources from, FrameInFlight& flight, Time now) const;
  std::optional<Time> EchoedAt(const FrameSources& from) const;
  std::size_t BytesUntil(Time until, const FrameSources& from, Time now) const;
  bool EndsTurn(const FrameSources& from, Time now) const;
  bool EndsTurn(const FrameSources& from, std::size_t frame_bytes, Time now) const;
  void Cut(FrameSources from, Time now, std::vector<std::byte>& out);
  void GiveUp(FrameSources from);
  void TakeBack(FrameSources from);
  void Finish(FrameSources from);

  const ChannelTable* table_;
  FrameSealer sealer_;
  LinkOptions options_;
  FrameLength length_;        ///< of the longest frames
  std::size_t message_bits_;  ///< of the largest entry of a message
  AgeBound age_bound_;
  Transmitter transmitter_;
  TurnTaking turns_;
  Repetition repetition_;
  Time acknowledged_at_{};  ///< when urgent events were last acknowledged in a frame of their own
  std::optional<FrameInFlight> flight_;
  CounterForm form_ = CounterForm::kWhole;  ///< of the next frame
  FrameKind last_ = FrameKind::kMixed;      ///< of the last frame
  Time last_data_;                          ///< begin of the last data frame sent
  SendCounters counters_;
};

}  // namespace priamos::bus::radio
