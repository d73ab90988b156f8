#include "cli/verbs/help/manual_page.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace priamos::cli {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

const ManualIssue kIssue{"2026-11-22", "priamos 0.1.0"};

/// What a call appended to an empty page.
template <class Add>
std::string Appended(const Add& add) {
  ManualPage page("priamos-x", 1, "to try", kIssue);
  const std::size_t before = page.Text().size();
  add(page);
  return page.Text().substr(before);
}

TEST(ManualPage, BeginsWithTitleSectionDateAndRelease) {
  const ManualPage dut("priamos-topic", 1, "See what is there.", kIssue);
  EXPECT_EQ(dut.Text(),
            ".TH \"PRIAMOS\\-TOPIC\" 1 \"2026-11-22\" \"priamos 0.1.0\" \"PRIAMOS\"\n.nh\n"
            ".SH \"NAME\"\npriamos\\-topic \\- See what is there\n");
  EXPECT_EQ(dut.FileName(), "priamos-topic.1");
}

TEST(ManualPage, AMinusCanBeCopiedAndABackslashIsNoEscape) {
  EXPECT_EQ(Appended([](ManualPage& page) { page.Paragraph("--set a\\b"); }), "\\-\\-set a\\eb\n");
}

TEST(ManualPage, ALineThatBeginsWithAPointIsNoCommand) {
  EXPECT_EQ(Appended([](ManualPage& page) { page.Paragraph(".lcm files\n'quoted'"); }),
            "\\&.lcm files\n\\&'quoted'\n");
}

TEST(ManualPage, ABlankLineBeginsAnotherParagraph) {
  EXPECT_EQ(Appended([](ManualPage& page) { page.Paragraph("one\ntwo\n  \nthree"); }),
            "one\ntwo\n.PP\nthree\n");
}

TEST(ManualPage, TheFirstParagraphOfASectionNeedsNoMacro) {
  EXPECT_EQ(Appended([](ManualPage& page) {
              page.Section("TWO WORDS");
              page.Paragraph("one");
              page.Paragraph("two");
              page.Subsection("say \"so\"");
              page.Paragraph("three");
            }),
            ".SH \"TWO WORDS\"\none\n.PP\ntwo\n.SS \"say \"\"so\"\"\"\nthree\n");
}

TEST(ManualPage, AnExampleKeepsItsLines) {
  EXPECT_EQ(Appended([](ManualPage& page) { page.Example("priamos up\n  priamos down"); }),
            ".nf\n.RS 4\npriamos up\n  priamos down\n.RE\n.fi\n");
}

TEST(ManualPage, ATermIsBoldAndItsRestIsNot) {
  EXPECT_EQ(Appended([](ManualPage& page) { page.Term("--json", " TEXT", "machine-readable"); }),
            ".TP\n\\fB\\-\\-json\\fR TEXT\nmachine\\-readable\n");
}

TEST(ManualPage, ATermWithoutTextIsNotFollowedByAnEmptyLine) {
  EXPECT_THAT(Appended([](ManualPage& page) { page.Term("x", "", ""); }), Not(HasSubstr("\n\n")));
}

TEST(ManualPage, ReferencesHaveCommasBetweenAndNoneBehind) {
  EXPECT_EQ(Appended([](ManualPage& page) {
              page.SeeAlso({"priamos(1)", "priamos-link(5)"});
            }),
            ".SH \"SEE ALSO\"\n.BR priamos (1),\n.BR priamos\\-link (5)\n");
}

/// troff reads a point, an apostrophe and a backslash; none of the text may reach it as such.
RC_GTEST_PROP(ManualPage, NoTextBecomesACommand, ()) {
  const auto text = *rc::gen::container<std::string>(rc::gen::elementOf(std::string(".'\\-\n ab\"")));
  const std::string dut = Appended([&](ManualPage& page) { page.Example(text); });
  const std::string body = dut.substr(std::string(".nf\n.RS 4\n").size(),
                                      dut.size() - std::string(".nf\n.RS 4\n.RE\n.fi\n").size());
  bool begins = true;
  for (std::size_t i = 0; i < body.size(); ++i) {
    RC_ASSERT(!begins || (body[i] != '.' && body[i] != '\''));
    if (body[i] == '\\') {
      RC_ASSERT(std::string("&e-").find(body[i + 1]) != std::string::npos);
    }
    begins = body[i] == '\n';
  }
}

}  // namespace
}  // namespace priamos::cli
