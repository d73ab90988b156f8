#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

extern "C" {
#include "frame.h"
#include "line_code.h"
}

// The frames of the small end against the test vectors of PROTOCOL.md.

namespace priamos {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::map<std::string, std::string> Vectors() {
  std::ifstream in(std::string(PRIAMOS_SOURCE_DIR) + "/bus/radio/PROTOCOL.md");
  std::map<std::string, std::string> vectors;
  for (std::string line; std::getline(in, line);)
    if (const auto at = line.find(" = "); at != std::string::npos && line.find(' ') == at)
      vectors[line.substr(0, at)] = line.substr(at + 3);
  return vectors;
}

Bytes FromHex(const std::string& hex) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

struct TinyVectors : testing::Test {
  std::map<std::string, std::string> values = Vectors();
  Bytes Hex(const std::string& name) const { return FromHex(values.at(name)); }
  std::uint64_t Number(const std::string& name) const { return std::stoull(values.at(name), nullptr, 16); }
  pr_scope Scope(bool encrypted = false, const std::string& hash = "table_hash") const {
    pr_scope scope{};
    pr_derive_keys(&scope, Hex("link_key").data());
    scope.table_hash = static_cast<std::uint32_t>(Number(hash));
    scope.code_bytes = 4;
    scope.echo_bytes = 1;
    scope.encrypted = encrypted;
    return scope;
  }
  Bytes Sealed(bool whole) const {
    const pr_scope scope = Scope();
    Bytes bundle = Hex("bundle_up"), out(PR_MAX_CONTENT + 2);
    out.resize(pr_seal(&scope, Number("epoch"), 300, whole, bundle.data(), bundle.size(), out.data()));
    return out;
  }
  /// The bundle of a frame that came down; empty when it is refused.
  Bytes Opened(const std::string& name, const pr_scope& scope,
               pr_window window = {0, ~std::uint64_t{0}}) const {
    const Bytes wire = Hex(name);
    Bytes content(wire.size());
    const bool block = name.starts_with("block");
    content.resize((block ? pr_block_decode : pr_cobs_decode)(wire.data(), wire.size() - 1, content.data()));
    pr_data data{};
    pr_hello hello{};
    if (pr_open(&scope, Number("epoch"), &window, 310, content.data(), content.size(), &data, &hello) !=
        PR_DATA)
      return {};
    return {data.bundle, data.bundle + data.bundle_bytes};
  }
};

TEST_F(TinyVectors, Keys) {
  const pr_scope scope = Scope();
  EXPECT_EQ(Bytes(scope.authentication_key, scope.authentication_key + 32), Hex("authentication_key"));
  EXPECT_EQ(Bytes(scope.encryption_key, scope.encryption_key + 32), Hex("encryption_key"));
  EXPECT_EQ(pr_epoch_of(&scope, Number("onboard_nonce"), Number("offboard_nonce")), Number("epoch"));
}

TEST_F(TinyVectors, FramesThatGoUp) {
  EXPECT_EQ(Sealed(false), Hex("frame_up_counter_300"));
  EXPECT_EQ(Sealed(true), Hex("frame_up_counter_300_whole"));
}

TEST_F(TinyVectors, FramesThatComeDown) {
  EXPECT_EQ(Opened("frame_down_counter_7", Scope()), Hex("bundle_down"));
  EXPECT_EQ(Opened("frame_down_counter_7_whole", Scope()), Hex("bundle_down"));
  pr_scope sealed = Scope(true, "table_hash_sealed");
  EXPECT_EQ(Opened("frame_down_counter_7_encrypted", sealed), Hex("bundle_down"));
  pr_scope fast = Scope();
  fast.echo_bytes = 2;
  EXPECT_EQ(Opened("frame_down_counter_7_fast", fast), Hex("bundle_down"));
  for (const std::uint8_t code : {6, 8}) {
    pr_scope longer = Scope(false, "table_hash_code_" + std::to_string(code));
    longer.code_bytes = code;
    EXPECT_EQ(Opened("frame_down_counter_7_code_" + std::to_string(code), longer), Hex("bundle_down"));
  }
}

TEST_F(TinyVectors, ABlockIsRead) {
  Bytes bundle = Opened("block_down_counter_7", Scope());
  ASSERT_GE(bundle.size(), Hex("bundle_down").size());
  bundle.resize(Hex("bundle_down").size());  // the rest is filled with zeros
  EXPECT_EQ(bundle, Hex("bundle_down"));
}

TEST_F(TinyVectors, WhatCameBeforeOrIsForAnotherIsRefused) {
  EXPECT_TRUE(Opened("frame_down_counter_7", Scope(), {100, ~std::uint64_t{0}}).empty());
  EXPECT_TRUE(Opened("frame_down_counter_7_whole", Scope(), {7, ~std::uint64_t{0}}).empty());
  EXPECT_TRUE(Opened("frame_down_counter_7", Scope(false, "table_hash_sealed")).empty());
  EXPECT_TRUE(Opened("frame_up_counter_300", Scope()).empty());  // the other direction
  EXPECT_FALSE(Opened("frame_down_counter_7_whole", Scope(), {6, ~std::uint64_t{0}}).empty());
}

}  // namespace
}  // namespace priamos
