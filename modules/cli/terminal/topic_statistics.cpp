#include "cli/terminal/topic_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "bus/schema/walk.hpp"

namespace priamos::cli {

void TopicStatistics::Add(Time now, std::string_view channel, std::span<const std::byte> bytes) {
  auto found = topics_.find(channel);
  if (found == topics_.end() && topics_.size() >= kMaxChannels) found = topics_.find(channel = kOthers);
  if (found == topics_.end()) found = topics_.emplace(std::string(channel), Topic{}).first;
  Topic& topic = found->second;
  const auto fingerprint = bus::FingerprintOf(bytes.data(), bytes.size());
  if (fingerprint != topic.fingerprint) {
    topic.fingerprint = fingerprint;
    topic.type = schema_.Find(fingerprint);
  }
  ++topic.messages;
  if (!topic.type || !bus::Walk(*topic.type, bytes)) ++topic.undecodable;
  topic.largest_bytes = std::max(topic.largest_bytes, bytes.size());
  topic.last = now;
  topic.recent.push_back({now, bytes.size()});
  while (topic.recent.size() > kMaxRecent || now - topic.recent.front().at > window_)
    topic.recent.pop_front();
}

TopicRow TopicStatistics::RowOf(const std::string& channel, const Topic& topic, Time now) const {
  TopicRow row{channel,
               topic.type ? topic.type->full_name : "?",
               topic.messages,
               topic.undecodable,
               0,
               0,
               0,
               0,
               topic.largest_bytes};
  row.age_s = Seconds(now - topic.last);
  double sum = 0, sum_squares = 0, bytes = 0;
  std::size_t intervals = 0;
  const Time* before = nullptr;
  for (const auto& arrival : topic.recent) {
    if (now - arrival.at > window_) continue;
    bytes += static_cast<double>(arrival.bytes);
    if (before) {
      const double interval = Seconds(arrival.at - *before);
      sum += interval;
      sum_squares += interval * interval;
      ++intervals;
    }
    before = &arrival.at;
  }
  row.bandwidth_bytes_s = bytes / Seconds(window_);
  if (intervals == 0 || sum <= 0) return row;
  const double mean = sum / static_cast<double>(intervals);
  row.rate_hz = 1 / mean;
  row.jitter_s = std::sqrt(std::max(0.0, sum_squares / static_cast<double>(intervals) - mean * mean));
  return row;
}

std::vector<TopicRow> TopicStatistics::Rows(Time now) const {
  std::vector<TopicRow> rows;
  for (const auto& [channel, topic] : topics_) rows.push_back(RowOf(channel, topic, now));
  return rows;
}

}  // namespace priamos::cli
