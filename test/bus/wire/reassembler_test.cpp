#include "bus/wire/reassembler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "bus/schema/big_endian.hpp"
#include "common/random.hpp"

namespace priamos::bus {
namespace {

using Bytes = std::vector<std::byte>;
using Result = Reassembler::Result;

Bytes Fragment(std::uint32_t number, std::uint32_t size, std::uint32_t offset, std::uint16_t fragment,
               std::uint16_t fragments, const Bytes& data) {
  Bytes bytes(FragmentHeader::kBytes + data.size());
  WriteBigEndian(bytes.data(), std::uint32_t{0x4c433033});
  WriteBigEndian(bytes.data() + 4, number);
  WriteBigEndian(bytes.data() + 8, size);
  WriteBigEndian(bytes.data() + 12, offset);
  WriteBigEndian(bytes.data() + 16, fragment);
  WriteBigEndian(bytes.data() + 18, fragments);
  std::copy(data.begin(), data.end(), bytes.begin() + FragmentHeader::kBytes);
  return bytes;
}

Bytes Data(std::size_t n) {
  Bytes data(n);
  for (std::size_t i = 0; i < n; ++i) data[i] = static_cast<std::byte>(i * 7);
  return data;
}

/// Fragments of a message on channel "BIG", cut as liblcm does.
std::vector<Bytes> Cut(std::uint32_t number, const Bytes& data, std::size_t piece) {
  std::vector<Bytes> fragments;
  const auto n = static_cast<std::uint16_t>((data.size() + piece - 1) / piece);
  for (std::uint16_t i = 0; i < n; ++i) {
    const std::size_t begin = i * piece, end = std::min(data.size(), begin + piece);
    Bytes part(data.begin() + static_cast<std::ptrdiff_t>(begin),
               data.begin() + static_cast<std::ptrdiff_t>(end));
    if (i == 0)
      for (const char c : {'\0', 'G', 'I', 'B'}) part.insert(part.begin(), static_cast<std::byte>(c));
    fragments.push_back(Fragment(number, static_cast<std::uint32_t>(data.size()),
                                 static_cast<std::uint32_t>(begin), i, n, part));
  }
  return fragments;
}

class ReassemblerTest : public testing::Test {
 protected:
  Result Add(const Bytes& datagram, std::uint64_t sender = 1) { return dut_.Add(sender, datagram, message_); }
  Result AddAll(const std::vector<Bytes>& fragments, std::uint64_t sender = 1) {
    Result last = Result::kWaiting;
    for (const auto& fragment : fragments) last = Add(fragment, sender);
    return last;
  }
  Reassembler dut_;
  Reassembler::Message message_;
};

TEST_F(ReassemblerTest, PutsAMessageTogether) {
  const auto fragments = Cut(5, Data(1000), 300);
  EXPECT_EQ(Add(fragments[0]), Result::kBegun);
  EXPECT_EQ(Add(fragments[1]), Result::kWaiting);
  EXPECT_EQ(Add(fragments[2]), Result::kWaiting);
  EXPECT_EQ(Add(fragments[3]), Result::kComplete);
  EXPECT_EQ(message_.channel, "BIG");
  EXPECT_EQ(message_.bytes, Data(1000));
  EXPECT_EQ(dut_.held_bytes(), 0u);
  EXPECT_EQ(dut_.abandoned(), 0u);
}

TEST_F(ReassemblerTest, InAnyOrderAndWithDuplicates) {
  Rng rng(1);
  for (std::uint32_t number = 0; number < 50; ++number) {
    auto fragments = Cut(number, Data(2000), 100);
    fragments.push_back(fragments[3]);
    std::shuffle(fragments.begin(), fragments.end(), rng.engine());
    int complete = 0;
    for (const auto& fragment : fragments) complete += Add(fragment) == Result::kComplete;
    EXPECT_EQ(complete, 1);
    EXPECT_EQ(message_.bytes, Data(2000));
  }
  EXPECT_EQ(dut_.abandoned(), 0u);
}

TEST_F(ReassemblerTest, SendersDoNotMix) {
  const auto a = Cut(5, Data(1000), 300), b = Cut(5, Data(900), 300);
  Add(a[0], 1);
  Add(b[0], 2);
  Add(b[1], 2);
  EXPECT_EQ(Add(b[2], 2), Result::kComplete);
  EXPECT_EQ(message_.bytes, Data(900));
  EXPECT_EQ(AddAll({a[1], a[2], a[3]}, 1), Result::kComplete);
  EXPECT_EQ(message_.bytes, Data(1000));
}

TEST_F(ReassemblerTest, TheNextMessageDropsAnUnfinishedOne) {
  Add(Cut(5, Data(1000), 300)[0]);
  EXPECT_EQ(AddAll(Cut(6, Data(1000), 300)), Result::kComplete);
  EXPECT_EQ(dut_.abandoned(), 1u);
}

TEST_F(ReassemblerTest, PiecesThatDoNotFitAreNoMessage) {
  auto fragments = Cut(5, Data(1000), 300);
  WriteBigEndian(fragments[1].data() + 12, std::uint32_t{299});
  EXPECT_EQ(AddAll(fragments), Result::kMalformed);
  EXPECT_EQ(dut_.held_bytes(), 0u);
}

/// What kills liblcm 1.3.1: an offset near 2^32.
TEST_F(ReassemblerTest, ImpossibleHeadersAreRefused) {
  constexpr std::uint32_t kHuge = 0xfffffff8;
  EXPECT_EQ(Add(Fragment(1, 100, kHuge, 0, 2, Data(50))), Result::kMalformed);
  EXPECT_EQ(Add(Fragment(1, kHuge, kHuge, 1, 2, Data(50))), Result::kMalformed);
  EXPECT_EQ(Add(Fragment(1, 100, 0, 2, 2, Data(50))), Result::kMalformed);
  EXPECT_EQ(Add(Fragment(1, 100, 0, 0, 0, Data(50))), Result::kMalformed);
  EXPECT_EQ(Add(Fragment(1, 100, 0, 0, 1, Data(50))), Result::kMalformed);
  EXPECT_EQ(Add(Fragment(1, 100, 0, 0, 2, {})), Result::kMalformed);
  EXPECT_EQ(dut_.held_bytes(), 0u);
}

TEST_F(ReassemblerTest, AFloodTakesBoundedMemory) {
  const Bytes data = Data(60'000);
  for (std::uint32_t i = 0; i < 3000; ++i) {
    Add(Fragment(i / 40, 60'000'000, i % 40 * 60'000, static_cast<std::uint16_t>(i % 40), 1000, data),
        i / 40);
    ASSERT_LE(dut_.held_bytes(), Reassembler::kMostBytes);
  }
  EXPECT_GT(dut_.abandoned(), 10u);
}

TEST_F(ReassemblerTest, RandomFragmentsDoNoHarm) {
  Rng rng(1);
  for (int i = 0; i < 50'000; ++i) {
    const auto small = [&](std::uint64_t n) { return static_cast<std::uint32_t>(rng.Below(n)); };
    auto data = Data(1 + small(40));
    if (rng.Chance(0.5)) data[small(data.size())] = std::byte{0};
    Add(Fragment(small(3), small(100), small(60), static_cast<std::uint16_t>(small(4)),
                 static_cast<std::uint16_t>(2 + small(3)), data),
        small(100));
  }
  EXPECT_LE(dut_.held_bytes(), Reassembler::kMostSenders * 5 * 200);
}

}  // namespace
}  // namespace priamos::bus
