#include "bus/claim_messages.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <random>

#include "bus/host/host_identity.hpp"

namespace priamos::bus {
namespace {

// @max of claim_t
constexpr std::size_t kRobotBytes = 32, kRoleBytes = 16, kClaimHostBytes = 64;

}  // namespace

claim_t ToMessage(const ClaimWord& word, Time now) {
  claim_t message{};
  message.utime = ToUtime(now);
  message.robot = word.who.robot.substr(0, kRobotBytes);
  message.role = word.who.role.substr(0, kRoleBytes);
  message.instance = word.who.instance;
  message.state = word.holds ? claim_t::HOLDS : claim_t::ASKS;
  message.age_us = word.age.count();
  message.host = word.who.host.substr(0, kClaimHostBytes);
  message.pid = word.who.pid;
  return message;
}

ClaimWord FromMessage(const claim_t& message) {
  return {{message.robot, message.role, message.instance, message.host, message.pid},
          message.state == claim_t::HOLDS,
          Duration(message.age_us)};
}

Claimant MakeClaimant(const std::string& robot, const std::string& role) {
  std::random_device source;
  std::uniform_int_distribution<std::int32_t> any(1, std::numeric_limits<std::int32_t>::max());
  return {robot, role, any(source), ThisHost().name, getpid()};
}

std::string Whereabouts(const ClaimWord& word, Time now) {
  const auto since = static_cast<std::time_t>(ToUtime(now - word.age) / 1'000'000);
  return fmt::format("pid {} on {}, since {:%F %T}", word.who.pid, word.who.host, fmt::localtime(since));
}

std::string Describe(const ClaimWord& word, Time now) {
  return fmt::format("`{}` of robot {}, {}", word.who.role, word.who.robot, Whereabouts(word, now));
}

}  // namespace priamos::bus
