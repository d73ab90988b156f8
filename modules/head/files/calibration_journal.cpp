#include "head/files/calibration_journal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/replace_file.hpp"
#include "common/text/text_hash.hpp"

namespace priamos::head {
namespace {

using nlohmann::json;

constexpr const char* kKind = "priamos-calibration-journal-1";

json ToJson(const CalibrationExposure& exposure) {
  const HeadSetting& s = exposure.setting;
  json cameras = json::array();
  for (const auto& discs : exposure.cameras) {
    json list = json::array();
    for (const SeenDisc& d : discs) list.push_back({d.disc, d.u_px, d.v_px, d.sigma_px});
    cameras.push_back(list);
  }
  return {{"pan_rad", s.pan_rad},     {"tilt_rad", s.tilt_rad},     {"vergence_rad", s.vergence_rad},
          {"zoom_step", s.zoom_step}, {"focus_step", s.focus_step}, {"discs", cameras}};
}

/// Exposure in a line of the journal. Throws json::exception or std::out_of_range for what is no such line.
CalibrationExposure FromJson(const json& line, int discs) {
  CalibrationExposure exposure;
  HeadSetting& s = exposure.setting;
  line.at("pan_rad").get_to(s.pan_rad);
  line.at("tilt_rad").get_to(s.tilt_rad);
  line.at("vergence_rad").get_to(s.vergence_rad);
  line.at("zoom_step").get_to(s.zoom_step);
  line.at("focus_step").get_to(s.focus_step);
  for (const json& list : line.at("discs")) {
    exposure.cameras.emplace_back();
    for (const json& d : list) {
      const SeenDisc seen{d.at(0), d.at(1), d.at(2), d.at(3)};
      if (seen.disc < 0 || seen.disc >= discs || !(seen.sigma_px > 0) ||
          !std::isfinite(seen.u_px + seen.v_px))
        throw std::out_of_range("no disc");
      exposure.cameras.back().push_back(seen);
    }
  }
  return exposure;
}

}  // namespace

std::string Fingerprint(const std::string& text) {
  return fmt::format("{:016x}", TextHash64(text));
}

CalibrationJournal::CalibrationJournal(std::string path, std::string fingerprint, int discs)
    : path_(std::move(path)), fingerprint_(std::move(fingerprint)), discs_(discs) {}

std::vector<CalibrationExposure> CalibrationJournal::Read() const {
  std::vector<CalibrationExposure> exposures;
  std::ifstream file(path_);
  std::string line;
  try {
    if (!std::getline(file, line)) return {};
    const json head = json::parse(line);
    if (head.at("kind") != kKind || head.at("fingerprint") != fingerprint_) return {};
    while (std::getline(file, line)) exposures.push_back(FromJson(json::parse(line), discs_));
  } catch (const std::exception&) {
    // Cut off in the middle of a line, or foreign: what came before counts.
  }
  return exposures;
}

std::vector<CalibrationExposure> CalibrationJournal::Resume() {
  auto exposures = Read();
  std::string text = json{{"kind", kKind}, {"fingerprint", fingerprint_}}.dump() + '\n';
  for (const CalibrationExposure& e : exposures) text += ToJson(e).dump() + '\n';
  const bool replaced = ReplaceFile(path_, text, false, 0644);
  file_.open(path_, std::ios::app);
  if (!replaced || !file_) throw std::runtime_error(fmt::format("{}: cannot be written", path_));
  return exposures;
}

void CalibrationJournal::Add(const CalibrationExposure& exposure) {
  file_ << ToJson(exposure).dump() << '\n';
  if (!file_.flush()) throw std::runtime_error(fmt::format("{}: cannot be written", path_));
}

void CalibrationJournal::Remove() {
  file_.close();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace priamos::head
