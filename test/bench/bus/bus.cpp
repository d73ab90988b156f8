// What the bus costs beside raw liblcm and raw sockets, in one run: round trip of a small message, `priamos
// topic list` on a busy bus, messages sent flat out, reading a log. Prints one line per figure with its
// bound; exit 1 if one is missed.
//   scripts/in-private-network build/bin/bench_bus [--quick]
#include <arpa/inet.h>
#include <fmt/format.h>
#include <lcm/lcm.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>
#include <tuple>

#include "bus/log/log_reader.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/schema/big_endian.hpp"
#include "lcmtypes/channels.hpp"
#include "test/bench/bus/throughput.hpp"

namespace priamos::bench {
namespace {

using SteadyClock = std::chrono::steady_clock;

int missed = 0;

double SecondsSince(SteadyClock::time_point start) {
  return std::chrono::duration<double>(SteadyClock::now() - start).count();
}

/// One figure; `bound` 0: none.
void Report(std::string_view what, double value, double bound, std::string_view unit) {
  const bool held = bound == 0 || value <= bound;
  missed += !held;
  fmt::print("{:62} {:9.3f} {:5} {}{}\n", what, value, unit, bound == 0 ? "" : fmt::format("<= {:g}", bound),
             held ? "" : "  MISSED");
  std::fflush(stdout);
}

double Quantile(std::vector<double> values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// 64 bytes behind the fingerprint.
odometry_t Sample() {
  odometry_t message{};
  message.x_m = 12.5;
  return message;
}

/// One end of a ping pong: what came is sent back on another channel.
class Peer {
 public:
  virtual ~Peer() = default;
  virtual void Send() = 0;
  /// Waits for a message and handles it; false after a second.
  virtual bool Handle() = 0;
};

constexpr const char* kChannels[] = {"PING", "PONG"};

/// The least that a bus on UDP multicast can be: a datagram to a group, and nobody looks into it.
template <std::size_t kBytes>
class SocketPeer : public Peer {
 public:
  SocketPeer(int out, bool echo) : out_(static_cast<char>(out)), echo_(echo) {
    inet_pton(AF_INET, "239.255.76.67", &group_.sin_addr);
    group_.sin_family = AF_INET;
    group_.sin_port = htons(7704);
    const int on = 1;
    const ip_mreq membership{group_.sin_addr, {htonl(INADDR_ANY)}};
    const bool open = setsockopt(in_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
                      bind(in_, reinterpret_cast<const sockaddr*>(&group_), sizeof group_) == 0 &&
                      setsockopt(in_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) == 0;
    if (!open) throw std::runtime_error("no multicast; next: scripts/in-private-network");
  }
  ~SocketPeer() override {
    close(in_);
    close(send_);
  }
  void Send() override {
    std::array<char, kBytes> bytes{out_};
    sendto(send_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&group_), sizeof group_);
  }
  bool Handle() override {
    pollfd waiting{in_, POLLIN, 0};
    std::array<char, kBytes> bytes{};
    do {  // its own messages wake it, too
      if (poll(&waiting, 1, 1000) != 1) return false;
    } while (recv(in_, bytes.data(), bytes.size(), 0) != kBytes || bytes[0] == out_);
    if (echo_) Send();
    return true;
  }

 private:
  char out_;
  bool echo_;
  sockaddr_in group_{};
  int in_ = socket(AF_INET, SOCK_DGRAM, 0), send_ = socket(AF_INET, SOCK_DGRAM, 0);
};

class RawPeer : public Peer {
 public:
  RawPeer(int out, bool echo) : out_(kChannels[out]), echo_(echo), bytes_(bus::Encode(Sample())) {
    lcm_subscribe(lcm_, kChannels[1 - out], &RawPeer::OnMessage, this);
  }
  ~RawPeer() override { lcm_destroy(lcm_); }
  void Send() override { lcm_publish(lcm_, out_, bytes_.data(), static_cast<unsigned>(bytes_.size())); }
  bool Handle() override { return lcm_handle_timeout(lcm_, 1000) > 0; }

 private:
  /// Handler of a message that decodes it as generated subscribe functions do.
  static void OnMessage(const lcm_recv_buf_t* buffer, const char*, void* self) {
    odometry_t message;
    if (message.decode(buffer->data, 0, static_cast<int>(buffer->data_size)) < 0) return;
    auto* peer = static_cast<RawPeer*>(self);
    if (peer->echo_) peer->Send();
  }
  lcm_t* lcm_ = lcm_create("udpm://239.255.76.67:7701?ttl=0");
  const char* out_;
  bool echo_;
  std::vector<std::byte> bytes_;
};

class WrappedPeer : public Peer {
 public:
  WrappedPeer(int out, bool echo)
      : echo_(echo),
        out_(node_.Advertise(Channel<odometry_t>{kChannels[out]})),
        in_(node_.Subscribe(Channel<odometry_t>{kChannels[1 - out]})) {}
  void Send() override { out_.Publish(Sample()); }
  bool Handle() override {
    pollfd waiting{bus_.fd(), POLLIN, 0};
    do {  // its own messages wake it, too
      if (poll(&waiting, 1, 1000) != 1) return false;
      bus_.Drain();
    } while (!in_.Take());
    if (echo_) Send();
    return true;
  }

 private:
  bus::Schema schema_ = bus::OwnTypes();
  bus::MonotonicClock clock_;
  bus::LcmBus bus_{"udpm://239.255.76.67:7702?ttl=0"};
  bus::Node node_{bus_, schema_, clock_};
  bool echo_;
  bus::Publisher<odometry_t> out_;
  bus::Latest<odometry_t> in_;
};

/// Large messages, of a type read at run time.
class LargePeer : public Peer {
 public:
  LargePeer(int out, bool echo) : echo_(echo), out_(kChannels[out]) {
    node_.SubscribeRaw(kChannels[1 - out], schema_,
                       [this](std::span<const std::byte>, Time) { heard_ = true; });
    bus::WriteBigEndian(bytes_.data(), schema_.Find("bench.large_t")->fingerprint);
    bus::WriteBigEndian(bytes_.data() + 8, static_cast<std::int32_t>(bytes_.size() - 12));
  }
  void Send() override { node_.PublishRaw(out_, bytes_); }
  bool Handle() override {
    pollfd waiting{bus_.fd(), POLLIN, 0};
    for (heard_ = false; !heard_; bus_.Drain())
      if (poll(&waiting, 1, 1000) != 1) return false;
    if (echo_) Send();
    return true;
  }

 private:
  bus::Schema schema_{{{"large_t.lcm", "package bench; struct large_t { int32_t n; byte data[n]; }"}}};
  bus::MonotonicClock clock_;
  bus::LcmBus bus_{"udpm://239.255.76.67:7705?ttl=0"};
  bus::Node node_{bus_, schema_, clock_};
  bool echo_, heard_ = false;
  const char* out_;
  std::vector<std::byte> bytes_ = std::vector<std::byte>(bus::LcmBus::kMaxMessageBytes);
};

/// A sender here, and its echo in another thread.
template <class P>
class PingPong {
 public:
  PingPong() {
    thread_ = std::thread([this] {
      P echo(1, true);
      ready_ = true;
      while (!stop_) echo.Handle();
    });
    while (!ready_) std::this_thread::yield();
  }
  ~PingPong() {
    stop_ = true;
    thread_.join();
  }
  void Measure(int n, std::vector<double>& micro_seconds) {
    for (int i = 0; i < n; ++i) {
      const auto start = SteadyClock::now();
      here_.Send();
      if (here_.Handle()) micro_seconds.push_back(1e6 * SecondsSince(start));
    }
  }

 private:
  P here_{0, false};
  std::atomic<bool> ready_ = false, stop_ = false;
  std::thread thread_;
};

/// Medians of round trips measured by turns, in microseconds.
template <class... Peers>
std::array<std::vector<double>, sizeof...(Peers)> ByTurns(bool quick) {
  std::tuple<PingPong<Peers>...> pairs;
  std::array<std::vector<double>, sizeof...(Peers)> times;
  const auto round = [&](int n) {
    std::apply(
        [&](auto&... pair) {
          std::size_t i = 0;
          (pair.Measure(n, times[i++]), ...);
        },
        pairs);
  };
  round(200);
  for (auto& warm_up : times) warm_up.clear();
  for (int block = 0; block < (quick ? 20 : 200); ++block) round(100);
  return times;
}

void RoundTrip(bool quick) {
  constexpr std::size_t kHeader = 8 + sizeof "PING";  // of LCM's datagrams
  const auto [socket, liblcm, bus] = ByTurns<SocketPeer<72 + kHeader>, RawPeer, WrappedPeer>(quick);
  Report("round trip of 64 bytes, raw sockets: median", Quantile(socket, 0.5), 0, "us");
  Report("round trip of 64 bytes, raw liblcm: median", Quantile(liblcm, 0.5), 0, "us");
  Report("round trip of 64 bytes, raw liblcm: 99 %", Quantile(liblcm, 0.99), 0, "us");
  Report("round trip of 64 bytes, bus: median", Quantile(bus, 0.5), 0, "us");
  Report("round trip of 64 bytes, bus: 99 %", Quantile(bus, 0.99), 0, "us");
  Report("median of bus / median of raw liblcm", Quantile(bus, 0.5) / Quantile(liblcm, 0.5), 1.1, "");
  Report("median of bus / median of raw sockets", Quantile(bus, 0.5) / Quantile(socket, 0.5), 1.3, "");
  const auto [large_socket, large_bus] =
      ByTurns<SocketPeer<bus::LcmBus::kMaxMessageBytes + kHeader>, LargePeer>(quick);
  Report("round trip of 1400 bytes, raw sockets: median", Quantile(large_socket, 0.5), 0, "us");
  Report("round trip of 1400 bytes, bus: median", Quantile(large_bus, 0.5), 0, "us");
  Report("1400 bytes: median of bus / median of raw sockets",
         Quantile(large_bus, 0.5) / Quantile(large_socket, 0.5), 1.2, "");
}

constexpr int kMessagesPerSecond = 10'000;

/// Sends on ten channels for so long; returns the number of messages.
std::uint64_t Flood(double seconds) {
  bus::LcmBus bus("udpm://239.255.76.67:7703?ttl=0");
  const auto bytes = bus::Encode(Sample());
  const auto start = SteadyClock::now();
  std::uint64_t sent = 0;
  while (SecondsSince(start) < seconds) {
    while (static_cast<double>(sent) < SecondsSince(start) * kMessagesPerSecond)
      bus.Publish(fmt::format("CHANNEL_{}", sent++ % 10), bytes);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return sent;
}

/// `priamos topic list` as a process: what it printed, and the CPU time it took.
class TopicList {
 public:
  TopicList(const std::string& program, double seconds) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    child_ = fork();
    if (child_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      execl(program.c_str(), "priamos", "topic", "list", "--json", "--bus", "udpm://239.255.76.67:7703?ttl=0",
            "--seconds", fmt::format("{}", seconds).c_str(), nullptr);
      _exit(127);
    }
    close(ends[1]);
    out_ = ends[0];
  }
  nlohmann::json End() {
    std::string text;
    char part[4096];
    for (ssize_t n = 0; (n = read(out_, part, sizeof part)) > 0;)
      text.append(part, static_cast<std::size_t>(n));
    close(out_);
    rusage use{};
    wait4(child_, nullptr, 0, &use);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    cpu_s = seconds(use.ru_utime) + seconds(use.ru_stime);
    return nlohmann::json::parse(text);
  }
  double cpu_s = 0;

 private:
  pid_t child_ = 0;
  int out_ = -1;
};

void BusyBus(const std::string& program, bool quick) {
  const double seconds = quick ? 2 : 10;
  TopicList list(program, seconds + 3);
  std::this_thread::sleep_for(std::chrono::seconds(1));
  const double sent = static_cast<double>(Flood(seconds));
  const auto answer = list.End();
  double heard = 0;
  for (const auto& channel : answer.at("channels")) heard += channel.at("messages").get<double>();
  const double lost = answer.at("lost").get<double>();
  Report("messages sent to `topic list` per second", sent / seconds, 0, "1/s");
  Report("its CPU time, with its start, per second of sending", 100 * list.cpu_s / seconds, 30, "%");
  Report("lost and reported", 100 * lost / sent, 0, "%");
  Report("lost and not reported", std::abs(sent - heard - lost), 1e-9, "");
}

void FlatOut(bool quick) {
  for (const std::size_t bytes : {std::size_t{72}, bus::LcmBus::kMaxMessageBytes}) {
    constexpr std::size_t kHeader = 8 + sizeof "FLOOD";  // of LCM's datagrams
    const double seconds = quick ? 1 : 5;
    const Throughput raw = SendRawFlatOut(bytes + kHeader, seconds), t = SendFlatOut(bytes, seconds);
    const std::string what = fmt::format("{} bytes flat out: ", bytes);
    const auto sent = static_cast<double>(t.sent);
    const auto per_second = [](std::uint64_t n, const Throughput& of) {
      return static_cast<double>(n) / of.seconds;
    };
    Report(what + "sent per second, raw sockets", per_second(raw.sent, raw), 0, "1/s");
    Report(what + "heard per second, raw sockets", per_second(raw.heard, raw), 0, "1/s");
    Report(what + "messages sent per second", per_second(t.sent, t), 0, "1/s");
    Report(what + "messages heard per second", per_second(t.heard, t), 0, "1/s");
    Report(what + "heard by raw sockets / heard by the bus",
           per_second(raw.heard, raw) / per_second(t.heard, t), 0, "");
    Report(what + "lost and reported", 100 * static_cast<double>(t.lost) / sent, 0, "%");
    Report(what + "lost and not reported",
           std::abs(sent - static_cast<double>(t.heard) - static_cast<double>(t.lost)), 1e-9, "");
  }
}

double LiblcmReadSeconds(const std::string& log, std::uint64_t& events) {
  const auto start = SteadyClock::now();
  lcm_eventlog_t* file = lcm_eventlog_create(log.c_str(), "r");
  events = 0;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(file)) {
    ++events;
    lcm_eventlog_free_event(event);
  }
  lcm_eventlog_destroy(file);
  return SecondsSince(start);
}

double ReadSeconds(const std::string& log, std::uint64_t& events) {
  const auto start = SteadyClock::now();
  bus::LogReader reader(log);
  for (events = 0; reader.Next(); ++events) {
  }
  return SecondsSince(start);
}

void ReadLog(const std::string& log, bool quick) {
  std::vector<double> ours, theirs;
  std::uint64_t n = 0, m = 0;
  for (int i = 0; i < (quick ? 20 : 200); ++i) {
    theirs.push_back(LiblcmReadSeconds(log, m));
    ours.push_back(ReadSeconds(log, n));
  }
  Report("events of the log that liblcm reads and we do not", static_cast<double>(m) - static_cast<double>(n),
         1e-9, "");
  Report("reading it: liblcm, median", 1e3 * Quantile(theirs, 0.5), 0, "ms");
  Report("reading it: bus/log, median", 1e3 * Quantile(ours, 0.5), 0, "ms");
}

}  // namespace
}  // namespace priamos::bench

int main(int argc, char** argv) {
  using namespace priamos::bench;
  bool quick = false;
  CLI::App app("What the bus costs");
  app.add_flag("--quick", quick, "a tenth of the samples");
  CLI11_PARSE(app, argc, argv);
  RoundTrip(quick);
  BusyBus(PRIAMOS_BINARY_DIR "/bin/priamos", quick);
  FlatOut(quick);
  ReadLog(PRIAMOS_SOURCE_DIR "/logs/recorded/door-onboard.lcmlog", quick);
  return missed > 0;
}
