#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace priamos::cli {

/// What a folder of a run holds for a comparison.
struct ComparedRun {
  std::string name;
  nlohmann::ordered_json summary;  ///< of summary.json
  std::string svg;                 ///< of run.svg; empty when there is none
};

/// A figure of two runs, by its place in the summary, `fixes[0].error_after_m`. Empty texts: that run has
/// none.
struct ComparedFigure {
  std::string key, a, b;
  std::string difference;  ///< b - a of numbers that differ, with its sign
};

/// Reads the folder of a run. Throws std::runtime_error, one sentence, when summary.json is missing or is
/// none.
ComparedRun LoadComparedRun(const std::filesystem::path& folder);

/// Every figure that one of them has, in the order of `a`.
std::vector<ComparedFigure> CompareSummaries(const nlohmann::ordered_json& a,
                                             const nlohmann::ordered_json& b);

/// Two runs side by side as one self-contained page, in the look of their reports.
std::string ComparisonPage(const ComparedRun& a, const ComparedRun& b);

}  // namespace priamos::cli
