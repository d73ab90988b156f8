#include "test/bench/bus/throughput.hpp"

#include <poll.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "bus/wire/lcm_bus.hpp"

namespace priamos::bench {
namespace {

constexpr const char* kBus = "udpm://239.255.76.67:7706?ttl=0";
constexpr int kQuiet_ms = 300;

/// Handles what comes until nothing does any more.
void Receive(bus::LcmBus& bus, const std::atomic<bool>& ended) {
  pollfd waiting{bus.fd(), POLLIN, 0};
  while (poll(&waiting, 1, kQuiet_ms) == 1 || !ended) bus.Drain();
}

}  // namespace

Throughput SendFlatOut(std::size_t bytes, double seconds) {
  Throughput result;
  bus::LcmBus receiver(kBus), sender(kBus);
  receiver.Subscribe("FLOOD", [&](std::string_view, std::span<const std::byte>) { ++result.heard; });
  std::atomic<bool> ended = false;
  std::thread listening([&] { Receive(receiver, ended); });
  const std::vector<std::byte> message(bytes);
  const auto start = std::chrono::steady_clock::now();
  const auto passed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  for (; passed() < seconds; result.seconds = passed())
    for (int i = 0; i < 100; ++i) result.sent += sender.Publish("FLOOD", message) ? 1 : 0;
  // A loss shows by the number behind it: one more message when it is quiet.
  std::this_thread::sleep_for(std::chrono::milliseconds(kQuiet_ms / 2));
  result.sent += sender.Publish("FLOOD", message) ? 1 : 0;
  ended = true;
  listening.join();
  result.lost = receiver.lost();
  return result;
}

}  // namespace priamos::bench
