// Bytes per message and messages per second, side by side with LCM datagrams and MAVLink-2-style framing.
#include <array>
#include <chrono>
#include <cstring>

#include "bus/schema/packing.hpp"
#include "bus/schema/schema.hpp"
#include "bus/type_files.hpp"
#include "figures.hpp"
#include "test/bus/radio/link_pair.hpp"

namespace priamos::bench {
namespace {

using namespace bus::radio;

constexpr double kLine_bytes_s = 960;

/// LCM's small message: magic, sequence number, channel with its zero; then the IPv4 and UDP heads.
constexpr std::size_t kLcmHead = 8, kUdpHead = 28;
/// MAVLink 2, mavlink.io/en/guide/serialization.html and message_signing.html: STX, length, two flags,
/// sequence, system, component, 3 of message id; checksum; link id, 6 of time stamp, 6 of signature.
constexpr std::size_t kMavlinkHead = 10, kMavlinkChecksum = 2, kMavlinkSignature = 13;

std::string BenchTypes() {
  return std::string(PRIAMOS_SOURCE_DIR) + "/test/bench/radio";
}

/// A MAVLink author takes the smallest whole number type that holds range and step; a time is 32 bit ms.
std::size_t MavlinkPayload(const bus::Packer& packer) {
  std::size_t bytes = 0;
  for (const bus::PackedField& field : packer.fields()) {
    const std::size_t one = field.unit == "us" ? 4 : field.bits <= 8 ? 1 : field.bits <= 16 ? 2 : 4;
    bytes += one * static_cast<std::size_t>(field.values);
  }
  return bytes;
}

LinkChannel ChannelOf(const std::string& name, const bus::Packer& packer, ChannelClass channel_class) {
  LinkChannel c;
  c.name = name;
  c.channel_class = channel_class;
  c.fixed_bits = static_cast<std::uint32_t>(packer.MaxBits());
  c.rate_hz = 0;
  c.ttl = channel_class == ChannelClass::kCommand ? Duration(250'000) : Duration(0);
  return c;
}

/// Messages per second that a saturated simulated link delivers of these channels together.
double DeliveredPerSecond(std::vector<LinkChannel> channels) {
  // The messages of LinkPair are whole bytes.
  for (LinkChannel& c : channels) c.fixed_bits = (c.fixed_bits + 7) / 8 * 8;
  LinkPair pair;
  pair.onboard.channels = pair.offboard.channels = channels;
  pair.Start(pair.onboard);
  pair.Start(pair.offboard);
  pair.Run(1);
  std::size_t delivered = 0;
  pair.each_step = [&] {
    for (std::size_t i = 0; i < channels.size(); ++i)
      pair.onboard.link->Offer(i, std::vector<std::byte>((channels[i].fixed_bits + 7) / 8, std::byte{0x5A}),
                               pair.now);
    delivered += pair.offboard.received.size();
    pair.offboard.received.clear();
  };
  pair.Run(30);
  return static_cast<double>(delivered) / 30;
}

std::size_t LcmSize(const bus::Struct& type) {
  return bus::MaxEncodedSize(type).value();
}

/// The three messages in one authenticated frame, delimiter and all.
std::size_t BundleOfThree(const std::vector<LinkChannel>& channels) {
  const ChannelTable table(channels, false);
  BundleWriter bundle(table);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    std::vector<std::byte> packed((channels[i].fixed_bits + 7) / 8);
    if (channels[i].channel_class == ChannelClass::kCommand) {
      bundle.Write(CommandEntry{i, {}, channels[i].fixed_bits, packed});
    } else {
      bundle.Write(StateEntry{i, channels[i].fixed_bits, packed});
    }
  }
  const FrameSealer sealer(FrameKeys(LinkKey{1}), Direction::kUp,
                           {table.hash(), false, EchoBytes(kLine_bytes_s)});
  return sealer.Seal(1, 5, CounterForm::kLowBits, bundle.bytes()).size();
}

double PackTime_ns(const bus::Packer& packer, const bus::Struct& type) {
  std::vector<std::byte> encoded(LcmSize(type));
  const std::uint64_t fingerprint = type.fingerprint;
  for (int i = 0; i < 8; ++i)
    encoded[static_cast<std::size_t>(i)] = static_cast<std::byte>(fingerprint >> (56 - 8 * i));
  constexpr int kTimes = 200'000;
  double best = 1e9;
  for (int round = 0; round < 5; ++round) {
    const auto start = std::chrono::steady_clock::now();
    std::size_t sum = 0;
    for (int i = 0; i < kTimes; ++i) sum += packer.Pack(encoded, i)->bytes.size();
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
    if (sum > 0) best = std::min(best, took.count() / kTimes);
  }
  return best;
}

}  // namespace

void SideBySide(Figures& figures) {
  const bus::Schema schema(bus::ReadTypeFiles(BenchTypes()));
  const std::array<const char*, 3> names{"pose_velocity_t", "sonars_t", "drive_t"};
  const std::array<double, 3> dccl{14, 32, 6};
  std::vector<LinkChannel> channels;
  Figures::Section("Side by side: bytes per message | messages per second on 960 byte/s, one type alone");
  fmt::print("  {:<18}{:>14}{:>22}{:>24}{:>20}\n", "type", "packed", "this link, signed",
             "LCM datagram (+IP/UDP)", "MAVLink 2, signed");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bus::Struct& type = *schema.Find(names[i]);
    const bus::Packer packer(type);
    channels.push_back(ChannelOf(names[i], packer, i == 2 ? ChannelClass::kCommand : ChannelClass::kState));
    const double rate = DeliveredPerSecond({channels.back()});
    const std::size_t lcm = kLcmHead + std::strlen(names[i]) + 1 + LcmSize(type);
    const std::size_t mavlink = kMavlinkHead + MavlinkPayload(packer) + kMavlinkChecksum + kMavlinkSignature;
    fmt::print("  {:<18}{:>14}{:>14.1f} |{:>6.1f}{:>12} (+{}) |{:>6.1f}{:>12} |{:>6.1f}\n", names[i],
               packer.MaxBytes(), kLine_bytes_s / rate, rate, lcm, kUdpHead,
               kLine_bytes_s / static_cast<double>(lcm + kUdpHead), mavlink,
               kLine_bytes_s / static_cast<double>(mavlink));
  }
  const double three = DeliveredPerSecond(channels) / 3;
  double lcm = 0, mavlink = 0;
  for (const char* name : names) {
    const bus::Struct& type = *schema.Find(name);
    lcm += static_cast<double>(kLcmHead + std::strlen(name) + 1 + LcmSize(type) + kUdpHead);
    mavlink += static_cast<double>(kMavlinkHead + MavlinkPayload(bus::Packer(type)) + kMavlinkChecksum +
                                   kMavlinkSignature);
  }
  fmt::print("  {:<18}{:>14}{:>14.1f} |{:>6.1f}{:>18.0f} |{:>6.1f}{:>12.0f} |{:>6.1f}\n", "all three", "",
             kLine_bytes_s / three, three, lcm, kLine_bytes_s / lcm, mavlink, kLine_bytes_s / mavlink);

  Figures::Section("Packing");
  for (std::size_t i = 0; i < names.size(); ++i)
    figures.AtMost(fmt::format("{} (DCCL 4.2: {:g})", names[i], dccl[i]), dccl[i],
                   static_cast<double>(bus::Packer(*schema.Find(names[i])).MaxBytes()), "byte");
  figures.AtMost("all three in one authenticated frame, delimiter and all", 52,
                 static_cast<double>(BundleOfThree(channels)), "byte");
  const bus::Struct& pose = *schema.Find("pose_velocity_t");
  figures.AtMost("packing the pose", 2000, PackTime_ns(bus::Packer(pose), pose), "ns");
}

}  // namespace priamos::bench
