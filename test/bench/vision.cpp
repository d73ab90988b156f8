// How well the head sees: every figure that is promised, beside the public state of the art on the same
// images in the same run.
//   bench_vision [--quick] [--photo FILE]... [--only edges|stereo]...
// Prints one line per figure with its bound; exit 1 if one is missed.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <ctime>
#include <opencv2/core/utility.hpp>

#include "test/bench/vision_bench.hpp"

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

int main(int argc, char** argv) {
  using namespace priamos::bench;
  VisionOptions options;
  std::vector<std::string> only;
  CLI::App app("Figures of seeing");
  app.add_flag("--quick", options.quick, "a tenth of the samples");
  app.add_option("--photo", options.photos, "photographs to take times on")->check(CLI::ExistingFile);
  app.add_option("--only", only, "these parts only")->check(CLI::IsMember({"edges", "stereo"}));
  CLI11_PARSE(app, argc, argv);
  cv::setNumThreads(1);
  const auto wanted = [&](std::string_view part) {
    return only.empty() || std::find(only.begin(), only.end(), part) != only.end();
  };
  Figures figures;
  if (wanted("edges")) BenchEdges(options, figures);
  if (wanted("stereo")) BenchStereo(options, figures);
  return figures.missed() > 0;
}
