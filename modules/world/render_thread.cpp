#include "world/render_thread.hpp"

#include <utility>

namespace priamos::world {

RenderThread::RenderThread(std::function<RenderFunction()> make) {
  std::exception_ptr failed;
  bool started = false;
  thread_ = std::thread([&, make = std::move(make)] { Run(make, failed, started); });
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return started; });
  if (!failed) return;
  lock.unlock();
  thread_.join();
  std::rethrow_exception(failed);
}

RenderThread::~RenderThread() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

/// Main function of the thread. `failed` and `started` belong to the constructor, which waits for `started`.
void RenderThread::Run(const std::function<RenderFunction()>& make, std::exception_ptr& failed,
                       bool& started) {
  RenderFunction render;
  std::exception_ptr error;
  try {
    render = make();
  } catch (...) {
    error = std::current_exception();
  }
  {
    const std::lock_guard lock(mutex_);
    failed = error;
    started = true;
    changed_.notify_all();
  }
  if (!error) DrawUntilStopped(render);
}

void RenderThread::DrawUntilStopped(const RenderFunction& render) {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stop_ || !jobs_.empty(); });
    if (stop_) return;
    const RenderJob job = jobs_.front();
    jobs_.pop_front();
    lock.unlock();
    DrawnPicture picture = Draw(render, job);
    lock.lock();
    results_[job.number] = std::move(picture);
  }
}

void RenderThread::Submit(const RenderJob& job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(job);
  }
  changed_.notify_all();
}

std::optional<GreyImage> RenderThread::Take(std::int64_t number) {
  const std::lock_guard lock(mutex_);
  return TakeFrom(results_, number);
}

}  // namespace priamos::world
