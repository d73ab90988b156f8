#include "radio/kiss_port.hpp"

#include <array>
#include <utility>

#include "bus/radio/frame/cobs.hpp"
#include "bus/radio/frame/kiss.hpp"

namespace priamos::radio {
namespace {

using bus::radio::kDelimiter;

/// No packet radio takes a longer one.
constexpr std::size_t kLongestPacket = 256;
constexpr std::size_t kSerialReadAtOnce = 256;

class KissPort : public NetPort {
 public:
  explicit KissPort(std::unique_ptr<ByteStream> serial) : serial_(std::move(serial)) {}

  std::vector<NetFrame> Read(const TimeSource& time) override {
    Flush();
    std::vector<NetFrame> frames;
    std::array<std::byte, kSerialReadAtOnce> buffer;
    for (std::size_t n = serial_->Read(buffer); n > 0; n = serial_->Read(buffer)) {
      // Taken after the reading: bytes must never seem to have arrived before they did.
      const Time now = time();
      for (const std::byte byte : std::span(buffer).first(n)) {
        if (decoder_.between_packets()) first_byte_ = now;
        if (auto packet = decoder_.Push(byte))
          frames.push_back({.bytes = std::move(*packet), .first_byte = first_byte_, .arrived = now});
      }
    }
    return frames;
  }

  /// There is one radio, and nobody else can be its place.
  void Judge(const NetFrame&, bus::radio::Proof) override {}

  std::size_t Write(std::span<const std::byte> bytes, Time) override {
    for (const std::byte b : bytes) {
      if (b != kDelimiter) {
        frame_.push_back(b);
        continue;
      }
      // A lone delimiter is nothing.
      if (!frame_.empty() && unwritten_.empty()) unwritten_ = bus::radio::EncodeKiss(frame_);
      frame_.clear();
    }
    Flush();
    return bytes.size();
  }

  std::uint64_t turned_away() const override { return 0; }

 private:
  void Flush() {
    if (unwritten_.empty()) return;
    const std::size_t n = serial_->Write(unwritten_);
    unwritten_.erase(unwritten_.begin(), unwritten_.begin() + static_cast<std::ptrdiff_t>(n));
  }

  std::unique_ptr<ByteStream> serial_;
  bus::radio::KissDecoder decoder_{kLongestPacket};
  Time first_byte_{};
  std::vector<std::byte> frame_;      ///< begun, without its delimiter
  std::vector<std::byte> unwritten_;  ///< of a packet, as KISS
};

constexpr const char* kPrefix = "kiss:";

}  // namespace

bool IsKissPort(const std::string& port) {
  return port.starts_with(kPrefix);
}

std::string TtyOf(const std::string& port) {
  return port.substr(std::string(kPrefix).size());
}

std::unique_ptr<NetPort> OpenKissPort(std::unique_ptr<ByteStream> serial) {
  return std::make_unique<KissPort>(std::move(serial));
}

}  // namespace priamos::radio
