#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <string>

#include "cli/options/log_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/report/report_comparison.hpp"
#include "cli/terminal/json_line.hpp"
#include "cli/verbs/run/commands.hpp"

namespace priamos::cli {
namespace {

struct ReportOptions {
  std::string a, b;
  std::string out = "comparison.html";
  bool force = false, json = false;
};

int Report(const ReportOptions& options) {
  const ComparedRun a = LoadComparedRun(options.a), b = LoadComparedRun(options.b);
  const auto figures = CompareSummaries(a.summary, b.summary);
  OutputFile out(options.out, "", options.force);
  out.stream() << ComparisonPage(a, b);
  out.Close();
  const auto differ =
      std::count_if(figures.begin(), figures.end(), [](const ComparedFigure& f) { return f.a != f.b; });
  if (options.json)
    std::cout << JsonLine({{"figures", std::int64_t(figures.size())},
                           {"differ", std::int64_t(differ)},
                           {"page", options.out}})
              << "\n";
  else
    std::cout << fmt::format("{} of {} figures differ; the page: {}\n", differ, figures.size(), options.out);
  return 0;
}

}  // namespace

void AddReportCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<ReportOptions>();
  auto* verb = AddVerb(cli, "report", "Two runs side by side, as a page: plans and every figure.");
  verb->footer(
      "Each run's own report is report.html in its folder.\n"
      "Example: priamos report logs/20260101-120000-door logs/20260102-120000-door");
  verb->add_option("a", options->a, "folder of a run")->required()->check(CLI::ExistingDirectory);
  verb->add_option("b", options->b, "folder of another run")->required()->check(CLI::ExistingDirectory);
  verb->add_option("--out", options->out, "the page that is written")->capture_default_str();
  verb->add_flag("--force", options->force, "replace an existing file");
  CompleteVerb(*verb, options, Report, exit_code, "the number of figures machine-readable");
}

}  // namespace priamos::cli
