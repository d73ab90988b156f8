// How well the head calibrates itself: every figure that is promised, measured on exactly rendered images,
// beside other detectors on the same images.
//   bench_calibration [--quick] [--seed N] [--only discs|labels|dlt|depth|table|laser|drift]...
// Prints one line per figure with its bound; exit 1 if one is missed.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>

#include "test/bench/calibration/calibration_bench.hpp"

int main(int argc, char** argv) {
  using namespace priamos::bench;
  const std::vector<std::pair<std::string, void (*)(const CalibrationOptions&, Figures&)>> parts{
      {"discs", BenchDiscs}, {"labels", BenchLabels}, {"dlt", BenchDlt},    {"depth", BenchDepth},
      {"table", BenchTable}, {"laser", BenchLaser},   {"drift", BenchDrift}};
  std::vector<std::string> names, only;
  for (const auto& [name, run] : parts) names.push_back(name);
  CalibrationOptions options;
  CLI::App app("Figures of calibration");
  app.add_option("--seed", options.seed, "of noise, views and heads")->capture_default_str();
  app.add_flag_callback(
      "--quick", [&] { options.scale = 10; }, "a tenth of the samples");
  app.add_option("--only", only, "these parts only")->check(CLI::IsMember(names));
  CLI11_PARSE(app, argc, argv);
  Figures figures;
  for (const auto& [name, run] : parts) {
    if (only.empty() || std::find(only.begin(), only.end(), name) != only.end()) run(options, figures);
  }
  fmt::print("{}\n",
             figures.missed() ? fmt::format("{} figures missed", figures.missed()) : "all figures held");
  return figures.missed() > 0;
}
