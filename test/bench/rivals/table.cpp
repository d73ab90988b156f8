#include "test/bench/rivals/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace priamos::bench {
namespace {

double MedianOf(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double MedianTime(const Row& row) {
  std::vector<double> times;
  for (const Drive& drive : row.drives)
    if (drive.passed()) times.push_back(drive.seconds);
  return MedianOf(times);
}

/// Time of a driver over that of the first, median over the cases that both passed.
double Relative(const Row& row, const Row& first) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < row.drives.size(); ++i)
    if (row.drives[i].passed() && first.drives[i].passed())
      ratios.push_back(row.drives[i].seconds / first.drives[i].seconds);
  return MedianOf(ratios);
}

int Passed(const Row& row) {
  return int(std::count_if(row.drives.begin(), row.drives.end(), [](const Drive& d) { return d.passed(); }));
}

/// Drives in which the base touched something by itself.
int Touched(const Row& row) {
  return int(
      std::count_if(row.drives.begin(), row.drives.end(), [](const Drive& d) { return d.contacts > 0; }));
}

int Stuck(const Row& row) {
  return int(std::count_if(row.drives.begin(), row.drives.end(),
                           [](const Drive& d) { return !d.arrived && d.contacts == 0; }));
}

double SmallestGap(const Row& row) {
  double least_m = 10;
  for (const Drive& drive : row.drives)
    if (drive.contacts == 0) least_m = std::min(least_m, drive.min_gap_m);
  return least_m;
}

double StepTime(const Row& row) {
  std::vector<double> times;
  for (const Drive& drive : row.drives) times.push_back(drive.step_s);
  return MedianOf(times);
}

int Came(const Row& row) {
  int came = 0;
  for (const Drive& drive : row.drives) came += drive.came > 0;
  return came;
}

}  // namespace

void PrintTable(const std::string& family, const std::vector<Row>& rows) {
  fmt::print("{}\n  {:18} {:>8} {:>8} {:>8} {:>6} {:>9} {:>9} {:>8} {:>9}\n", family, "driver", "passed",
             "touched", "stuck", "came", "median s", "relative", "gap cm", "step us");
  for (const Row& row : rows)
    fmt::print("  {:18} {:>5}/{:<2} {:>8} {:>8} {:>6} {:>9.1f} {:>9.2f} {:>8.1f} {:>9.0f}\n", row.driver,
               Passed(row), row.drives.size(), Touched(row), Stuck(row), Came(row), MedianTime(row),
               Relative(row, rows.front()), 100 * SmallestGap(row), 1e6 * StepTime(row));
  std::fflush(stdout);
}

std::vector<std::string> Defeats(const std::string& family, const std::vector<Row>& rows) {
  constexpr double kSame = 0.99;
  std::vector<std::string> defeats;
  const Row& first = rows.front();
  const auto add = [&](const Row& row, const std::string& what) {
    defeats.push_back(fmt::format("{}: {} {}", family, row.driver, what));
  };
  for (const Row& row : rows) {
    if (row.driver.starts_with(first.driver)) continue;  // itself, and with a planner
    if (Passed(row) > Passed(first)) add(row, fmt::format("passes {}, not {}", Passed(row), Passed(first)));
    if (Touched(row) < Touched(first))
      add(row, fmt::format("touches {}, not {}", Touched(row), Touched(first)));
    if (const double relative = Relative(row, first); relative < kSame)
      add(row, fmt::format("takes {:.2f} of the time where both pass", relative));
  }
  return defeats;
}

}  // namespace priamos::bench
