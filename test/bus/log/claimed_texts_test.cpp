#include "bus/log/claimed_texts.hpp"

#include <gmock/gmock.h>

namespace priamos::bus {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<std::string> AllOf(const ClaimedTexts& dut) {
  std::vector<std::string> texts;
  dut.AnyText([&](const std::string& text) {
    texts.push_back(text);
    return false;
  });
  return texts;
}

TEST(ClaimedTexts, ATextIsWholeWhenAllItsPartsAreThere) {
  ClaimedTexts dut;
  dut.Add(1, 2, "b");
  EXPECT_THAT(AllOf(dut), IsEmpty());
  dut.Add(0, 2, "a");
  EXPECT_THAT(AllOf(dut), ElementsAre("ab"));
  dut.Add(0, 3, "c");
  EXPECT_THAT(AllOf(dut), ElementsAre("ab")) << "of another number of parts";
}

TEST(ClaimedTexts, NewerPartsGoFirstAndAllChoicesAreTried) {
  ClaimedTexts dut;
  for (const char* part : {"a", "A"}) dut.Add(0, 2, part);
  for (const char* part : {"b", "B"}) dut.Add(1, 2, part);
  EXPECT_THAT(AllOf(dut), ElementsAre("AB", "aB", "Ab", "ab"));
  EXPECT_TRUE(dut.AnyText([](const std::string& text) { return text == "aB"; }));
  dut.Add(0, 2, "a");
  EXPECT_EQ(AllOf(dut).front(), "aB") << "said again, it is the newest";
}

TEST(ClaimedTexts, MemoryAndWorkAreBounded) {
  ClaimedTexts dut;
  const std::string long_part(1200, 'x');
  for (int i = 0; i < 1000; ++i)
    for (const int part : {0, 1, 2}) dut.Add(part, 3, long_part + std::to_string(i));
  EXPECT_LE(dut.bytes(), 3 * ClaimedTexts::kMostVersions * 1300);
  const auto texts = AllOf(dut);
  EXPECT_THAT(texts, SizeIs(testing::Le(ClaimedTexts::kMostTries)));
  EXPECT_EQ(texts.front(), long_part + "999" + long_part + "999" + long_part + "999");
  std::size_t seen = 0;
  for (const std::string& text : texts) seen += text.size();
  EXPECT_LE(seen, 8 * dut.bytes());
}

TEST(ClaimedTexts, ATextOfManyChoicesKeepsNoOtherFromBeingTried) {
  ClaimedTexts dut;
  dut.Add(0, 1, "genuine");
  for (int i = 0; i < 20; ++i)
    for (const int part : {0, 1, 2}) dut.Add(part, 3, std::string(1000, 'x') + std::to_string(i));
  EXPECT_THAT(AllOf(dut), testing::Contains("genuine"));
}

/// As LogTypes does, with every part.
void AddAfterProof(ClaimedTexts& dut, const std::string& text) {
  if (dut.NeedsProof()) dut.Keep([](const std::string& whole) { return whole == "genuine"; });
  dut.Add(0, 1, text);
}

TEST(ClaimedTexts, OneThatProvesItselfIsKeptWhereverItCame) {
  for (int before = 0; before < 20; ++before) {
    ClaimedTexts dut;
    for (int i = 0; i < before; ++i) AddAfterProof(dut, std::to_string(i));
    AddAfterProof(dut, "genuine");
    for (int i = 20; i < 220; ++i) AddAfterProof(dut, std::to_string(i));
    EXPECT_THAT(AllOf(dut), testing::Contains("genuine")) << before;
  }
}

TEST(ClaimedTexts, AProofSeesEachOnce) {
  ClaimedTexts dut;
  int seen = 0;
  for (int i = 0; i < 1000; ++i) {
    if (dut.NeedsProof()) dut.Keep([&](const std::string&) { return ++seen < 0; });
    dut.Add(0, 1, std::to_string(i));
  }
  EXPECT_LE(seen, 1000);
}

TEST(ClaimedTexts, ItKnowsItsMemory) {
  ClaimedTexts dut, same;
  for (int i = 0; i < 100; ++i) dut.Add(i % 3, 3, std::to_string(i % 30));
  for (int i = 60; i < 100; ++i) same.Add(i % 3, 3, std::to_string(i % 30));
  EXPECT_EQ(dut.bytes(), same.bytes()) << "what was forgotten counts no longer";
}

}  // namespace
}  // namespace priamos::bus
