#include "test/bench/bus/owner_networks.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace priamos::bench {
namespace {

constexpr const char* kOwnNetwork = "/proc/self/ns/net";

void Require(bool done, const std::string& what) {
  if (!done) throw std::runtime_error(fmt::format("{}: {}", what, std::strerror(errno)));
}

void Command(const std::string& command) {
  if (std::system(command.c_str()) != 0)
    throw std::runtime_error(command + ": expected exit code 0; run it by scripts/in-private-network");
}

int OpenNetwork() {
  const int fd = open(kOwnNetwork, O_RDONLY | O_CLOEXEC);
  Require(fd >= 0, kOwnNetwork);
  return fd;
}

}  // namespace

TwoNetworks::TwoNetworks() : hub_(OpenNetwork()) {
  Command("ip link add hub0 type bridge mcast_snooping 0 && ip link set hub0 up");
  left_ = Make("left", "10.77.0.1/24");
  right_ = Make("right", "10.77.0.2/24");
  Join();
}

TwoNetworks::~TwoNetworks() {
  for (const int fd : {hub_, left_, right_}) close(fd);
}

int TwoNetworks::Make(const std::string& name, const std::string& address) const {
  Require(unshare(CLONE_NEWNET) == 0, "unshare");
  const int network = OpenNetwork();
  Require(setns(hub_, CLONE_NEWNET) == 0, "setns");
  Command(
      fmt::format("ip link add port-{} type veth peer name eth9 && ip link set eth9 netns /proc/{}/fd/{} "
                  "&& ip link set port-{} up",
                  name, getpid(), network, name));
  Require(setns(network, CLONE_NEWNET) == 0, "setns");
  Command(
      fmt::format("ip link set lo up && ip addr add {} dev eth9 && ip link set eth9 up multicast on && "
                  "ip route add 224.0.0.0/4 dev eth9",
                  address));
  Require(setns(hub_, CLONE_NEWNET) == 0, "setns");
  return network;
}

void TwoNetworks::Cut() {
  Command("ip link set port-right nomaster");
}

void TwoNetworks::Join() {
  Command("ip link set port-left master hub0 && ip link set port-right master hub0");
}

void TwoNetworks::In(Side side, const std::function<void()>& make) const {
  Require(setns(side == Side::kLeft ? left_ : right_, CLONE_NEWNET) == 0, "setns");
  make();
  Require(setns(hub_, CLONE_NEWNET) == 0, "setns");
}

Program::Program(const TwoNetworks& networks, TwoNetworks::Side side, std::vector<std::string> arguments,
                 const std::string& console)
    : console_(console) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  networks.In(side, [&] {
    pid_ = fork();
    if (pid_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int output = open(console.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  });
  Require(pid_ > 0, "fork");
}

Program::~Program() {
  if (Ended()) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

void Program::Signal(int signal) const {
  if (!ended_) kill(pid_, signal);
}

bool Program::Ended() {
  int status = 0;
  if (ended_ || waitpid(pid_, &status, WNOHANG) != pid_) return ended_;
  ended_ = true;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return true;
}

std::string Program::Console() const {
  std::ostringstream text;
  text << std::ifstream(console_).rdbuf();
  return text.str();
}

}  // namespace priamos::bench
