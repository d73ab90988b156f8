#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>

#include "world/core/head/camera_server.hpp"

namespace priamos::world {

/// Draws pictures in a thread of its own: in real time a picture takes longer than the drive board may wait.
class RenderThread : public RenderExecutor {
 public:
  /// Starts the thread. `make` is called in it, because what draws belongs to the thread that made it.
  /// Returns when it has returned; throws what it threw.
  explicit RenderThread(std::function<RenderFunction()> make);
  /// Finishes the picture under way and drops the others.
  ~RenderThread() override;
  RenderThread(const RenderThread&) = delete;
  RenderThread& operator=(const RenderThread&) = delete;

  void Submit(const RenderJob& job) override;
  std::optional<GreyImage> Take(std::int64_t number) override;

 private:
  void Run(const std::function<RenderFunction()>& make, std::exception_ptr& failed, bool& started);
  void DrawUntilStopped(const RenderFunction& render);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<RenderJob> jobs_;
  std::map<std::int64_t, DrawnPicture> results_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace priamos::world
