#include "head/see/see.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "head/see/find_doors.hpp"
#include "head/see/see_doors.hpp"
#include "head/see/see_drawing.hpp"
#include "head/see/see_findings.hpp"
#include "head/see/see_image_doors.hpp"
#include "head/see/see_json.hpp"
#include "head/see/see_landmark.hpp"
#include "head/see/see_output.hpp"
#include "head/see/see_text.hpp"

namespace priamos::head {
namespace {

/// Name of the list that stands for no file: whoever asked prints the list.
constexpr std::string_view kNoFile = "-";

/// All that `options` ask for.
std::vector<PlannedDrawing> Plan(const SeeOptions& options) {
  std::vector<PlannedDrawing> drawings;
  for (const std::string& image : options.images) drawings.push_back({image, "edges"});
  if (!options.cameras.empty() && options.images.size() > 1)
    drawings.push_back({options.images.front(), "stereo"});
  if (WantsDoors(options)) drawings.push_back({options.images.front(), "doors"});
  if (!options.landmark.empty()) drawings.push_back({options.images.front(), "landmark"});
  return drawings;
}

bool IsOfOneImage(const SeenDoors& seen) {
  return seen.cameras.size() == 1;
}

SeeOutput OutputOf(const SeeOptions& options) {
  std::vector<std::string> inputs = options.images;
  inputs.insert(inputs.end(), options.cameras.begin(), options.cameras.end());
  if (!options.landmark.empty()) inputs.push_back(options.landmark);
  if (!options.json.empty() && options.json != kNoFile) RefuseToReplace(options.json, inputs, options.force);
  return {Plan(options), inputs, options.output, options.force};
}

void Draw(const SeeFindings& findings, SeeOutput& output) {
  for (const SeenPhotograph& p : findings.photographs)
    output.Add(p.file, "edges", DrawContours(p.grey, p.edges, p.contours).ToPng());
  const SeenPhotograph& first = findings.photographs.front();
  const std::vector<cv::Mat> greys = findings.Greys();
  if (findings.matches)
    output.Add(first.file, "stereo", DrawMatches(greys, findings.views, *findings.matches).ToPng());
  if (const auto& seen = findings.doors)
    output.Add(
        first.file, "doors",
        (IsOfOneImage(*seen) ? DrawImageDoors(first.grey, *seen) : DrawDoors(greys, seen->views, seen->doors))
            .ToPng());
  if (const auto& seen = findings.landmark)
    output.Add(first.file, "landmark",
               DrawLandmark(first.grey, findings.views, seen->body, seen->believed, seen->fix).ToPng());
}

nlohmann::ordered_json ToJson(const SeeFindings& findings) {
  auto images = nlohmann::ordered_json::array();
  for (const SeenPhotograph& p : findings.photographs) {
    images.push_back(EdgesToJson(p.file, p.edges, p.contours));
    if (const auto why = WhyBlind(p.edges); !why.empty()) images.back()["unusable"] = why;
  }
  nlohmann::ordered_json all{{"images", images}};
  if (findings.matches) all["matches"] = MatchesToJson(findings.views, *findings.matches);
  if (const auto& seen = findings.doors) {
    all["stand"] = StandToJson(*seen);
    all["doors"] = IsOfOneImage(*seen) ? ImageDoorsToJson(*seen) : DoorsToJson(seen->doors);
  }
  if (findings.landmark) all["landmark"] = LandmarkToJson(findings.views, findings.landmark->fix);
  return all;
}

std::string ToText(const SeeFindings& findings, const std::string& model_file, const SeeOutput& output) {
  std::string text;
  for (const SeenPhotograph& p : findings.photographs) text += EdgesText(p, output.FileOf(p.file, "edges"));
  const std::string& first = findings.photographs.front().file;
  if (findings.matches) text += MatchesText(*findings.matches, output.FileOf(first, "stereo"));
  if (const auto& seen = findings.doors) {
    const std::string drawing = output.FileOf(first, "doors");
    text += StandText(*seen);
    text += IsOfOneImage(*seen) ? ImageDoorsText(*seen, drawing) : DoorsText(seen->doors, drawing);
  }
  if (findings.landmark)
    text += LandmarkText(model_file, findings.landmark->fix, output.FileOf(first, "landmark"));
  return text;
}

}  // namespace

SeeReport See(const SeeOptions& options) {
  if (!options.landmark.empty() && options.cameras.empty())
    throw std::runtime_error(
        fmt::format("{}: expected a camera for each image to look for it", options.landmark));
  SeeOutput output = OutputOf(options);
  const SeeFindings findings = FindAll(options);
  Draw(findings, output);
  output.Write();
  SeeReport report;
  report.found = (!findings.landmark || findings.landmark->fix.verdict == Verdict::kFound) &&
                 (!findings.doors || findings.doors->why_not.empty());
  if (!findings.note.empty()) report.notes = findings.note + "\n";
  report.text = ToText(findings, options.landmark, output);
  if (options.json.empty()) return report;
  const std::string json = ToJson(findings).dump(1) + "\n";
  options.json == kNoFile ? void(report.json = json) : WriteWhole(options.json, json);
  return report;
}

}  // namespace priamos::head
