#include "console/audience.hpp"

#include "console/core/json_line.hpp"

namespace priamos::console {
namespace {

using Json = nlohmann::ordered_json;

Json ItemsSince(const News& news, std::uint64_t seen, Time now) {
  Json items = Json::array();
  for (const News::Item* item : news.Since(seen))
    items.push_back({{"key", item->key},
                     {"channel", item->channel},
                     {"type", item->type},
                     {"age_s", Seconds(now - item->valid)},
                     {"message", item->message}});
  return items;
}

}  // namespace

Role Audience::RoleOf(ClientId client) const {
  const auto page = pages_.find(client);
  return page == pages_.end() ? Role::kViewer : page->second.role;
}

void Audience::StartAgain() {
  for (auto& [client, page] : pages_) page = {page.role, 0, false};
}

void Audience::Tell(WebServer& server, const std::string& greeting, const News& news, std::int64_t beat,
                    Time now, const Station& station) {
  for (auto& [client, page] : pages_) {
    if (!page.greeted) {
      page.greeted = server.Send(client, greeting);
      continue;
    }
    const Json text = {{"type", "news"},
                       {"beat", beat},
                       {"station", station(client, page.role)},
                       {"items", ItemsSince(news, page.seen, now)}};
    if (server.Send(client, JsonLine(text))) page.seen = news.newest();
  }
}

}  // namespace priamos::console
