#include "cli/report/report_picture.hpp"

#include <gmock/gmock.h>

#include <set>

#include "common/config.hpp"
#include "common/drawing/svg.hpp"
#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

const std::string kDeployment = PRIAMOS_SOURCE_DIR "/config/sim";

drawing::Drawing Drawn(const RunRecord& record) {
  static const auto plan = LoadConfig<GroundPlan>(kDeployment + "/maps/door.toml");
  RunInfo info = TestInfo();
  info.world = LoadTrueWorld(kDeployment, LoadScenario(kDeployment, "door"), info.seed);
  return DrawRun(record, Summarise(record, info), info, plan);
}

std::vector<drawing::Text> TextsOf(const drawing::Drawing& page, std::string_view layer = "") {
  std::vector<drawing::Text> texts;
  for (const auto& shape : page.shapes())
    if (const auto* text = std::get_if<drawing::Text>(&shape.form);
        text && (layer.empty() || shape.layer->id == layer))
      texts.push_back(*text);
  return texts;
}

std::vector<std::string> WordsOf(const drawing::Drawing& page, std::string_view layer = "") {
  std::vector<std::string> words;
  for (const auto& text : TextsOf(page, layer)) words.push_back(text.text);
  return words;
}

std::set<std::string> LayersOf(const drawing::Drawing& page) {
  std::set<std::string> layers;
  for (const auto& shape : page.shapes()) layers.emplace(shape.layer->id);
  return layers;
}

/// A run that went wrong in every way.
RunRecord Crash() {
  return SyntheticRun{.end_s = 9, .done = false, .contacts = 2}.Record();
}

TEST(ReportPicture, ShowsPlanTruthBeliefAndFixes) {
  const auto dut = LayersOf(Drawn(SyntheticRun{}.Record()));
  EXPECT_THAT(dut, IsSupersetOf({"wall", "door-frame", "truth-thing", "truth-path", "truth-footprint",
                                 "belief-path", "belief-sigma", "look", "look-place", "correction"}));
}

TEST(ReportPicture, WhatStoodInTheWayHasItsNameAndIsMarkedAsTruth) {
  const auto dut = Drawn(SyntheticRun{}.Record());
  EXPECT_THAT(WordsOf(dut, "label"), IsSupersetOf({"cupboard", "carton", "bin", "armchair", "leaf"}));
  EXPECT_THAT(WordsOf(dut, "legend"), Contains(HasSubstr("truth (world)")));
}

TEST(ReportPicture, LegendExplainsEveryLayerAndNothingElse) {
  for (const RunRecord& record : {SyntheticRun{}.Record(), Crash(), RunRecord{}}) {
    const auto dut = Drawn(record);
    std::set<std::string> meanings;
    for (const auto& shape : dut.shapes())
      if (!shape.layer->meaning.empty()) meanings.emplace(shape.layer->meaning);
    EXPECT_THAT(WordsOf(dut, "legend"), testing::UnorderedElementsAreArray(meanings));
  }
}

TEST(ReportPicture, TextsDoNotOverlapAndStayOnThePage) {
  for (const RunRecord& record : {SyntheticRun{}.Record(), Crash(), RunRecord{}}) {
    const auto page = Drawn(record);
    const auto texts = TextsOf(page);
    EXPECT_GT(texts.size(), 20u);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      EXPECT_TRUE((drawing::Box{0, 0, page.width(), page.height()}).Holds(texts[i].box())) << texts[i].text;
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_FALSE(texts[i].box().Overlaps(texts[k].box())) << texts[i].text << " and " << texts[k].text;
    }
  }
}

/// A third of its size is the width of a telephone; letters of 8 px can still be read.
TEST(ReportPicture, CanBeReadOnATelephone) {
  const auto dut = Drawn(SyntheticRun{}.Record());
  EXPECT_DOUBLE_EQ(dut.width(), 1200);
  for (const auto& text : TextsOf(dut)) EXPECT_GE(text.font.size, 24) << text.text;
  for (const auto& text : TextsOf(dut, "legend")) EXPECT_GE(text.font.size, 30) << text.text;
}

TEST(ReportPicture, AnEmptyRecordGivesThePlanAlone) {
  const auto dut = LayersOf(Drawn(RunRecord{}));
  EXPECT_THAT(dut, IsSupersetOf({"wall", "truth-thing"}));
  EXPECT_THAT(dut, Not(Contains("truth-path")));
  EXPECT_THAT(dut, Not(Contains("belief-path")));
}

TEST(ReportPicture, FailureIsRedAndContactsAreMarked) {
  const std::string good = drawing::ToSvg(Drawn(SyntheticRun{}.Record())),
                    bad = drawing::ToSvg(Drawn(Crash()));
  EXPECT_THAT(good, HasSubstr("<g class=\"verdict\">\n<polygon fill=\"#12915a\""));
  EXPECT_THAT(good, Not(HasSubstr("#c0322b")));
  EXPECT_THAT(bad, HasSubstr("<g class=\"verdict\">\n<polygon fill=\"#c0322b\""));
  EXPECT_THAT(bad, HasSubstr("<g class=\"contact\">"));
}

TEST(ReportPicture, UpIsFromTheRobotToTheWorkstation) {
  RunRecord record;
  link_status_t link{};
  link.onboard = true;
  link.bytes_sent = 4321;
  Feed(record, Side::kOnboard, 1, "LINK_STATUS", link);
  link.onboard = false;
  link.bytes_sent = 1234;
  Feed(record, Side::kOffboard, 1, "LINK_STATUS", link);
  EXPECT_THAT(WordsOf(Drawn(record)),
              Contains("radio: 4321 bytes up (robot to workstation), 1234 bytes down"));
}

TEST(ReportPicture, TruePathIsWhereTheRobotWas) {
  RunRecord record;
  for (const double x : {2.0, 4.0}) {
    world_truth_t truth{};
    truth.x_m = x;
    truth.y_m = 1.2;
    Feed(record, Side::kOnboard, x, "WORLD_TRUTH", truth);
  }
  const auto page = Drawn(record);
  const auto path = std::find_if(page.shapes().begin(), page.shapes().end(),
                                 [](const auto& shape) { return shape.layer->id == "truth-path"; });
  ASSERT_NE(path, page.shapes().end());
  const auto& points = std::get<drawing::Path>(path->form).points;
  // 10.28 m of plan across the window.
  EXPECT_NEAR((points[1] - points[0]).x(), 2 * path->clip->width / 10.28, 0.01);
  EXPECT_NEAR(points[0].x(), path->clip->x + (2.0 + 0.14) * path->clip->width / 10.28, 0.01);
  EXPECT_NEAR(points[0].y(), path->clip->middle().y() + 1.2 * path->clip->width / 10.28, 0.01);
}

TEST(ReportPicture, PositionsBeyondThePlanDoNoHarm) {
  RunRecord record;
  for (int i = 0; i < 3; ++i) {
    world_truth_t truth{};
    truth.x_m = 1e300 * (i - 1);
    truth.y_m = -1e12;
    Feed(record, Side::kOnboard, i, "WORLD_TRUTH", truth);
    pose_t pose{};
    pose.x_m = -1e200 * i;
    pose.sigma_x_m = 1e100;
    Feed(record, Side::kOnboard, i, "POSE", pose);
  }
  EXPECT_THAT(drawing::ToSvg(Drawn(record)), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace priamos::cli
