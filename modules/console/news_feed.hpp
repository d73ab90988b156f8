#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "common/time.hpp"
#include "console/core/news.hpp"

namespace priamos::bus {
class Schema;
}

namespace priamos::console {

/// Messages of a bus or a log as news for pages.
class NewsFeed {
 public:
  /// `schema` must outlive it.
  explicit NewsFeed(const bus::Schema& schema) : schema_(schema) {}

  /// Takes a message. One of a type that nobody knows is left out.
  void Hear(const std::string& channel, std::span<const std::byte> bytes, Time arrival);
  const News& news() const { return news_; }
  /// Forgets everything that was heard.
  void Forget();

 private:
  const bus::Schema& schema_;
  News news_;
  std::map<std::string, std::uint64_t, std::less<>> heard_;  ///< messages so far, by channel
};

}  // namespace priamos::console
