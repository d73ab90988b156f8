#include "test/bench/figures.hpp"

#include <fmt/format.h>

#include <ctime>

namespace priamos::bench {

void Figures::Print(std::string_view what, double value, std::string_view unit, std::string_view relation,
                    double bound, bool held) {
  missed_ += !held;
  fmt::print("{:66} {:10.4f} {:5} {} {:<8g} {}\n", what, value, unit, relation, bound, held ? "" : "MISSED");
  std::fflush(stdout);
}
void Figures::AtMost(std::string_view what, double value, double bound, std::string_view unit) {
  Print(what, value, unit, "<=", bound, value <= bound);
}
void Figures::AtLeast(std::string_view what, double value, double bound, std::string_view unit) {
  Print(what, value, unit, ">=", bound, value >= bound);
}
void Figures::Note(std::string_view what, double value, std::string_view unit) {
  fmt::print("{:66} {:10.4f} {:5}\n", what, value, unit);
  std::fflush(stdout);
}

double CpuSeconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

}  // namespace priamos::bench
