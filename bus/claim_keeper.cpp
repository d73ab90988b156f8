#include "bus/claim_keeper.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "bus/claim_messages.hpp"
#include "bus/node.hpp"
#include "bus/schema/schema.hpp"
#include "bus/schema/walk.hpp"
#include "bus/wire/lcm_bus.hpp"

namespace priamos::bus {
namespace {

constexpr Duration kLongestWait{50'000};

bool IsReadable(int fd) {
  pollfd poll_fd{fd, POLLIN, 0};
  return poll(&poll_fd, 1, 0) > 0;
}

}  // namespace

Signal::Signal() : fd_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (fd_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
}

Signal::~Signal() {
  close(fd_);
}

void Signal::Set() const {
  eventfd_write(fd_, 1);
}

ClaimKeeper::ClaimKeeper(LcmBus& bus, const Schema& schema, const Clock& clock, const Claimant& self,
                         const ClaimTerms& terms, Log log)
    : bus_(bus),
      schema_(schema),
      clock_(clock),
      log_(std::move(log)),
      receiver_(bus.url()),
      claim_(self, clock.Now(), terms.ask_for),
      alone_(terms.speaks_alone) {
  Ask();
  thread_ = std::thread([this] { Run(); });
}

ClaimKeeper::~ClaimKeeper() {
  stop_.Set();
  thread_.join();
}

std::optional<std::string> ClaimKeeper::lost() const {
  const std::lock_guard lock(mutex_);
  return why_lost_;
}

/// On the caller's thread, which has nothing to do before it knows.
void ClaimKeeper::Ask() {
  while (claim_.state() == Claim::State::kAsking) {
    Say();
    Wait();
    Listen();
  }
  if (claim_.state() == Claim::State::kRefused) throw BusError(WhyRefused());
  if (const auto intruder = alone_.Find(clock_.Now(), Duration::zero()))
    throw BusError(WhyForeign(*intruder));
}

void ClaimKeeper::Run() {
  while (!IsReadable(stop_.fd())) {
    Say();
    Wait();
    Listen();
    if (ReportLoss()) return;
  }
}

void ClaimKeeper::Wait() {
  const Duration until = std::clamp(claim_.next_step() - clock_.Now(), Duration::zero(), kLongestWait);
  const timespec time{0, static_cast<long>(until.count() * 1000)};
  pollfd fds[] = {{receiver_.fd(), POLLIN, 0}, {stop_.fd(), POLLIN, 0}};
  ppoll(fds, std::size(fds), &time, nullptr);
}

void ClaimKeeper::Listen() {
  constexpr int kBurst = 1000;
  if (claim_.Touch(clock_.Now())) {
    // Messages that arrived while this process did not run may be of a sender that is gone.
    while (receiver_.Receive(kBurst, [](auto, auto, auto) {}) == kBurst) continue;
    return alone_.Forget();
  }
  receiver_.Receive(kBurst, [this](std::uint64_t sender, std::string_view channel,
                                   std::span<const std::byte> bytes) { OnMessage(sender, channel, bytes); });
}

void ClaimKeeper::OnMessage(std::uint64_t sender, std::string_view channel,
                            std::span<const std::byte> bytes) {
  if (channel == channels::kClaim.name) return OnClaim(sender, bytes);
  alone_.Hear(sender, channel, clock_.Now());
}

void ClaimKeeper::OnClaim(std::uint64_t sender, std::span<const std::byte> bytes) {
  const auto message = DecodeChecked<claim_t>(schema_, bytes);
  if (!message) return;
  const ClaimWord word = FromMessage(*message);
  if (word.who.role == claim_.self().role) alone_.Excuse(sender, clock_.Now());
  if (word.holds && claim_.state() == Claim::State::kAsking) others_.push_back(word);
  claim_.Hear(word, clock_.Now());
}

void ClaimKeeper::Say() {
  const Time now = clock_.Now();
  if (const auto word = claim_.Step(now)) bus_.Publish(channels::kClaim.name, Encode(ToMessage(*word, now)));
}

std::string ClaimKeeper::WhyRefused() const {
  const Claimant& self = claim_.self();
  const ClaimWord& winner = *claim_.winner();
  if (winner.who.robot != self.robot)
    return fmt::format(
        "bus {}: expected no robot but {}, got {}: both names lead to the same address; take another name "
        "with "
        "--robot",
        bus_.url(), self.robot, Describe(winner, clock_.Now()));
  return fmt::format(
      "bus {}: expected no other `{}` of robot {}, got {}; end that one first (`priamos down`, `systemctl "
      "stop priamos.target`, or kill {}), or start a robot of another name with --robot",
      bus_.url(), self.role, self.robot, Whereabouts(winner, clock_.Now()), winner.who.pid);
}

std::string ClaimKeeper::WhyForeign(const SoleSpeaker::Intruder& intruder) const {
  return fmt::format(
      "bus {}: expected nobody to send {} beside `{}`, got messages from {}: where devices answer "
      "nothing has to stand in for them; end their drivers, or start a robot of another name with --robot",
      bus_.url(), intruder.channel, claim_.self().role, SenderAddress(intruder.sender));
}

void ClaimKeeper::Alarm(int severity, const std::string& text) {
  constexpr std::size_t kTextBytes = 200;  // @max of alarm_t.text
  alarm_t message{};
  message.utime = ToUtime(clock_.Now());
  message.severity = static_cast<std::int8_t>(severity);
  message.robot = claim_.self().robot;
  message.source = claim_.self().role;
  message.text = text.substr(0, kTextBytes);
  bus_.Publish(channels::kAlarm.name, Encode(message));
  log_(Level::kError, "ALARM: " + text);
}

void ClaimKeeper::Lose(const std::string& why) {
  Alarm(alarm_t::CRITICAL, why);
  {
    const std::lock_guard lock(mutex_);
    why_lost_ = why;
  }
  lost_.Set();
}

/// Returns whether the role is lost.
bool ClaimKeeper::ReportLoss() {
  const Time now = clock_.Now();
  if (const auto loser = claim_.TakeLoser())
    Alarm(alarm_t::WARNING, fmt::format("two held one role and this one goes on; the other has to yield: {}",
                                        Describe(*loser, now)));
  if (claim_.state() == Claim::State::kYielded) {
    Lose(fmt::format("two held one role and this one yields to {}", Describe(*claim_.winner(), now)));
    return true;
  }
  const auto intruder = alone_.Find(now);
  if (intruder) Lose(WhyForeign(*intruder));
  return intruder.has_value();
}

}  // namespace priamos::bus
