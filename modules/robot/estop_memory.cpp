#include "robot/estop_memory.hpp"

#include <chrono>
#include <stdexcept>

namespace priamos::robot {
namespace {

constexpr std::chrono::seconds kBetweenTries{1};

}  // namespace

EstopMemory::EstopMemory(std::string path)
    : file_(std::move(path)), last_(file_.Load()), why_latched_(WhyLatched(last_)) {}

void EstopMemory::Begin(bool estop) {
  file_.Save(estop ? LastWord::kEstop : LastWord::kRunning);
}

void EstopMemory::End(bool estop) {
  file_.Save(estop ? LastWord::kEstop : LastWord::kEnded);
}

std::string EstopMemory::Forget() {
  try {
    file_.Save(LastWord::kRunning);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

std::string EstopMemory::Keep(Time now) {
  if (again_ && now < *again_) return "";
  try {
    file_.Save(LastWord::kEstop);
  } catch (const std::exception& error) {
    again_ = now + kBetweenTries;
    return error.what();
  }
  return "";
}

}  // namespace priamos::robot
