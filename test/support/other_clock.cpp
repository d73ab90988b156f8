// A library that is loaded before a program (LD_PRELOAD): the program sees other clocks than the machine's.
// OTHER_CLOCK_STEP_S: a wall clock that was set forward; OTHER_CLOCK_PPM: a clock since boot that gains so
// many parts in a million; OTHER_CLOCK_AHEAD_S: one that is so far ahead; OTHER_CLOCK_JUMP_MS: one that steps
// by so much when the machine's is at OTHER_CLOCK_JUMP_AT_S.

#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>

namespace {

long Variable(const char* name) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::atol(text) : 0;
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  constexpr long long kBillion = 1'000'000'000;
  const auto result = static_cast<int>(syscall(SYS_clock_gettime, clock, time));
  if (result == 0 && clock == CLOCK_REALTIME) time->tv_sec += Variable("OTHER_CLOCK_STEP_S");
  if (result == 0 && clock == CLOCK_BOOTTIME) {
    const long long ns = time->tv_sec * kBillion + time->tv_nsec;
    const long long jump =
        time->tv_sec >= Variable("OTHER_CLOCK_JUMP_AT_S") ? 1'000'000 * Variable("OTHER_CLOCK_JUMP_MS") : 0;
    const long long other =
        ns + ns / 1'000'000 * Variable("OTHER_CLOCK_PPM") + kBillion * Variable("OTHER_CLOCK_AHEAD_S") + jump;
    *time = {static_cast<time_t>(other / kBillion), static_cast<long>(other % kBillion)};
  }
  return result;
}
