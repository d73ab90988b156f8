#include "common/frame_store.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

namespace priamos {
namespace {

std::string Name() {
  return "test-" + std::to_string(getpid());
}

GreyImage Image(std::uint8_t grey) {
  return {4, 3, std::vector<std::uint8_t>(12, grey)};
}

TEST(FrameStore, ReaderGetsWhatTheWriterStored) {
  auto writer = FrameStore::Create(Name());
  const auto dut = FrameStore::Attach(Name());
  ASSERT_TRUE(dut);
  const int slot = writer.Write(7, Image(42));
  const auto image = dut->Read(slot, 7);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->width, 4);
  EXPECT_EQ(image->pixels, Image(42).pixels);
}

TEST(FrameStore, OverwrittenImageIsNotReturned) {
  auto writer = FrameStore::Create(Name());
  const auto dut = FrameStore::Attach(Name());
  const int slot = writer.Write(1, Image(1));
  for (int id = 2; id <= 1 + FrameStore::kSlots; ++id) writer.Write(id, Image(2));
  EXPECT_FALSE(dut->Read(slot, 1));
}

TEST(FrameStore, SlotFromAHostileMessageIsRefused) {
  auto writer = FrameStore::Create(Name());
  const auto dut = FrameStore::Attach(Name());
  EXPECT_FALSE(dut->Read(-1, 0));
  EXPECT_FALSE(dut->Read(FrameStore::kSlots, 0));
  EXPECT_FALSE(dut->Read(3, 0));
}

TEST(FrameStore, ImageThatDoesNotFitIsRefused) {
  auto writer = FrameStore::Create(Name());
  EXPECT_THROW(writer.Write(1, {4096, 4096, std::vector<std::uint8_t>(4096 * 4096)}), std::invalid_argument);
  EXPECT_THROW(writer.Write(1, {4, 4, std::vector<std::uint8_t>(3)}), std::invalid_argument);
}

TEST(FrameStore, NothingIsLeftBehind) {
  { auto writer = FrameStore::Create(Name()); }
  EXPECT_FALSE(FrameStore::Attach(Name()));
}

TEST(FrameStore, SecondCreatorReplacesAStoreLeftByADeadProcess) {
  auto left_behind = FrameStore::Create(Name());
  auto dut = FrameStore::Create(Name());
  const int slot = dut.Write(5, Image(9));
  const auto reader = FrameStore::Attach(Name());
  EXPECT_TRUE(reader->Read(slot, 5));
}

TEST(FrameStore, OneThatWasReplacedDoesNotRemoveItsSuccessor) {
  std::optional<FrameStore> replaced = FrameStore::Create(Name());
  auto dut = FrameStore::Create(Name());
  replaced.reset();
  EXPECT_TRUE(FrameStore::Attach(Name()));
}

}  // namespace
}  // namespace priamos
