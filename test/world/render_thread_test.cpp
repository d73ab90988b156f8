#include "world/render_thread.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <stdexcept>

namespace priamos::world {
namespace {

RenderJob Job(std::int64_t number) {
  RenderJob job;
  job.number = number;
  return job;
}

/// Takes a picture that will come.
GreyImage Await(RenderThread& dut, std::int64_t number) {
  while (true) {
    if (auto image = dut.Take(number)) return *image;
    std::this_thread::yield();
  }
}

TEST(RenderThreadTest, DrawsInTheThreadThatMadeTheRenderer) {
  std::thread::id made;
  std::promise<std::thread::id> drawn;
  RenderThread dut([&]() -> RenderFunction {
    made = std::this_thread::get_id();
    return [&](const RenderJob&) {
      drawn.set_value(std::this_thread::get_id());
      return GreyImage{1, 1, {0}};
    };
  });
  dut.Submit(Job(1));
  EXPECT_EQ(drawn.get_future().get(), made);
  EXPECT_NE(made, std::this_thread::get_id());
  Await(dut, 1);
}

TEST(RenderThreadTest, SubmitDoesNotWaitForThePicture) {
  std::promise<void> gate;
  const std::shared_future<void> opened = gate.get_future().share();
  RenderThread dut([&] {
    return RenderFunction([opened](const RenderJob& job) {
      opened.wait();
      return GreyImage{1, 1, {static_cast<std::uint8_t>(job.number)}};
    });
  });
  dut.Submit(Job(1));
  dut.Submit(Job(2));
  EXPECT_FALSE(dut.Take(1));  // would not be reached if Submit drew
  gate.set_value();
  EXPECT_EQ(Await(dut, 2).pixels[0], 2);
  EXPECT_EQ(Await(dut, 1).pixels[0], 1);
  EXPECT_FALSE(dut.Take(1));
}

TEST(RenderThreadTest, WhatTheMakerThrowsComesOutOfTheConstructor) {
  EXPECT_THROW(RenderThread([]() -> RenderFunction { throw std::runtime_error("no OpenGL"); }),
               std::runtime_error);
}

TEST(RenderThreadTest, WhatDrawingThrowsComesOutOfTake) {
  RenderThread dut([] {
    return RenderFunction([](const RenderJob&) -> GreyImage { throw std::runtime_error("out of memory"); });
  });
  dut.Submit(Job(1));
  EXPECT_THROW(Await(dut, 1), std::runtime_error);
}

TEST(RenderThreadTest, EndsWithPicturesStillToDraw) {
  std::atomic<int> drawn = 0;
  {
    RenderThread dut([&] {
      return RenderFunction([&](const RenderJob&) {
        ++drawn;
        return GreyImage{1, 1, {0}};
      });
    });
    for (int i = 0; i < 50; ++i) dut.Submit(Job(i));
  }
  EXPECT_LE(drawn, 50);
}

}  // namespace
}  // namespace priamos::world
