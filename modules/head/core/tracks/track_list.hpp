#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace priamos::head {

/// Begins a track of what a look showed first, under the number after `last_id`, which travels as 0 to 255;
/// of more than `most` tracks that goes which was not seen for longest.
template <class Track>
void BeginTrack(Track seen, int most, int& last_id, std::vector<Track>& tracks) {
  constexpr int kIds = 256;
  if (tracks.size() >= static_cast<std::size_t>(most))
    tracks.erase(std::min_element(tracks.begin(), tracks.end(),
                                  [](const Track& a, const Track& b) { return a.seen < b.seen; }));
  last_id = (last_id + 1) % kIds;
  seen.id = last_id;
  tracks.push_back(std::move(seen));
}

}  // namespace priamos::head
