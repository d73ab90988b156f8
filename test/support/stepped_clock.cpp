// A library that is loaded before a program (LD_PRELOAD): the program sees a wall clock that was set an hour
// forward. All other clocks are the machine's.

#include <sys/syscall.h>
#include <unistd.h>

#include <ctime>

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  constexpr time_t kStep_s = 3600;
  const auto result = static_cast<int>(syscall(SYS_clock_gettime, clock, time));
  if (result == 0 && clock == CLOCK_REALTIME) time->tv_sec += kStep_s;
  return result;
}
