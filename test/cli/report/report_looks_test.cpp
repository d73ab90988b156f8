#include "cli/report/report_looks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "bus/node.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

RunRecord RecordOf(const landmark_view_t& view, const landmark_fix_t& fix) {
  RunRecord record;
  record.Add(Side::kOnboard, 1, "LANDMARK_VIEW", bus::Encode(view));
  record.Add(Side::kOnboard, 1, "LANDMARK_FIX", bus::Encode(fix));
  return record;
}

landmark_view_t View() {
  landmark_view_t view{};
  view.request_id = 4;
  for (std::int8_t kind = 0; kind < 3; ++kind) {
    view_edge_t edge{};
    edge.kind = kind;
    edge.u1_px = 10.0F * kind;
    edge.v2_px = 576;
    view.edges.push_back(edge);
  }
  view.n_edges = 3;
  return view;
}

TEST(ReportLooksTest, WithoutALookThereIsNothing) {
  EXPECT_EQ(LookDrawings(RunRecord()), "");
}

TEST(ReportLooksTest, DrawsEveryEdgeByItsKindAndNamesTheVerdict) {
  landmark_fix_t fix{};
  fix.request_id = 4;
  fix.n_matched = 15;
  const std::string html = LookDrawings(RecordOf(View(), fix));
  EXPECT_THAT(html, HasSubstr("<line class=\"expected\" x1=\"0.0\""));
  EXPECT_THAT(html, HasSubstr("<line class=\"matched\" x1=\"10.0\""));
  EXPECT_THAT(html, HasSubstr("<line class=\"rejected\" x1=\"20.0\""));
  EXPECT_THAT(html, HasSubstr("FOUND; 15 edges"));
}

TEST(ReportLooksTest, LooksAreCountedFromOneAndKeepTheirNumberInTheLog) {
  RunRecord record;
  for (const std::int32_t id : {1003, 1003, 1007}) {
    landmark_view_t view = View();
    view.request_id = id;
    record.Add(Side::kOnboard, 1, "LANDMARK_VIEW", bus::Encode(view));
  }
  const std::string html = LookDrawings(record);
  EXPECT_THAT(html, HasSubstr("<figcaption>look 1 (1003 in the log): landmark "));
  EXPECT_THAT(html, HasSubstr("<figcaption>look 2 (1007 in the log): landmark "));
  EXPECT_THAT(html, Not(HasSubstr("look 3")));
}

TEST(ReportLooksTest, AnEdgeThatIsNoneIsLeftOut) {
  landmark_view_t view = View();
  view.edges[0].kind = 7;
  view.edges[1].u1_px = std::numeric_limits<float>::infinity();
  const std::string html = LookDrawings(RecordOf(view, {}));
  EXPECT_THAT(html, Not(HasSubstr("expected\" x1")));
  EXPECT_THAT(html, Not(HasSubstr("inf")));
  EXPECT_THAT(html, HasSubstr("rejected\" x1"));
}

}  // namespace
}  // namespace priamos::cli
