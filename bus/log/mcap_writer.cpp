#include "bus/log/mcap_writer.hpp"

#include <algorithm>
#include <ostream>

#include "bus/log/crc32.hpp"

namespace priamos::bus {
namespace {

constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};
enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// Little endian content of a record.
class Content {
 public:
  template <class T>
  Content& Put(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) text_.push_back(static_cast<char>(value >> (8 * i) & 0xff));
    return *this;
  }
  /// Appends a text with its length in front.
  Content& Text(std::string_view text) {
    Put(static_cast<std::uint32_t>(text.size()));
    text_.append(text);
    return *this;
  }
  Content& Raw(std::string_view text) {
    text_.append(text);
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string Record(std::uint8_t opcode, std::string_view content) {
  Content record;
  record.Put(opcode).Put(static_cast<std::uint64_t>(content.size())).Raw(content);
  return record.text();
}

template <class Map>
Content& PutMap(Content& content, const Map& map) {
  content.Put(static_cast<std::uint32_t>(map.size() * 10));
  for (const auto& [id, value] : map) content.Put(id).Put(value);
  return content;
}

}  // namespace

McapWriter::McapWriter(std::ostream& out) : out_(out) {
  Write(kMcapMagic);
  WriteRecord(kHeader, Content().Text("").Text("priamos").text());
}

void McapWriter::Write(std::string_view bytes) {
  data_crc_ = Crc32(data_crc_, bytes);
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  written_ += bytes.size();
}

void McapWriter::WriteRecord(std::uint8_t opcode, std::string_view content) {
  Write(Record(opcode, content));
}

std::uint16_t McapWriter::AddSchema(std::string_view name, std::string_view json_schema) {
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  schemas_.push_back(Content().Put(id).Text(name).Text("jsonschema").Text(json_schema).text());
  chunk_ += Record(kSchema, schemas_.back());
  return id;
}

std::uint16_t McapWriter::AddChannel(std::string_view topic, std::uint16_t schema) {
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  constexpr std::uint32_t kNoMetadata = 0;
  channels_.push_back(Content().Put(id).Put(schema).Text(topic).Text("json").Put(kNoMetadata).text());
  chunk_ += Record(kChannel, channels_.back());
  return id;
}

void McapWriter::AddMessage(std::uint16_t channel, std::uint32_t sequence, std::uint64_t time_ns,
                            std::string_view json) {
  const bool first_of_chunk = chunk_index_.empty();
  chunk_start_ns_ = first_of_chunk ? time_ns : std::min(chunk_start_ns_, time_ns);
  chunk_end_ns_ = first_of_chunk ? time_ns : std::max(chunk_end_ns_, time_ns);
  chunk_index_[channel].emplace_back(time_ns, chunk_.size());
  chunk_ += Record(kMessage, Content().Put(channel).Put(sequence).Put(time_ns).Put(time_ns).Raw(json).text());
  start_ns_ = messages_ == 0 ? time_ns : std::min(start_ns_, time_ns);
  end_ns_ = messages_ == 0 ? time_ns : std::max(end_ns_, time_ns);
  ++messages_;
  ++counts_[channel];
  if (chunk_.size() >= kChunkBytes) EndChunk();
}

void McapWriter::EndChunk() {
  if (chunk_.empty()) return;
  ChunkInfo info{chunk_start_ns_, chunk_end_ns_, written_, 0, 0, chunk_.size(), {}};
  Content content;
  content.Put(chunk_start_ns_).Put(chunk_end_ns_).Put(static_cast<std::uint64_t>(chunk_.size()));
  content.Put(Crc32(0, chunk_)).Text("").Put(static_cast<std::uint64_t>(chunk_.size())).Raw(chunk_);
  WriteRecord(kChunk, content.text());
  info.bytes = written_ - info.offset;
  WriteIndexes(info);
  chunks_.push_back(info);
  chunk_.clear();
  chunk_index_.clear();
  chunk_start_ns_ = chunk_end_ns_ = 0;
}

void McapWriter::WriteIndexes(ChunkInfo& info) {
  const std::uint64_t begin = written_;
  for (auto& [channel, entries] : chunk_index_) {
    info.index_offsets[channel] = written_;
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    Content content;
    content.Put(channel).Put(static_cast<std::uint32_t>(entries.size() * 16));
    for (const auto& [time_ns, offset] : entries) content.Put(time_ns).Put(offset);
    WriteRecord(kMessageIndex, content.text());
  }
  info.index_bytes = written_ - begin;
}

std::string McapWriter::Statistics() const {
  Content content;
  content.Put(messages_)
      .Put(static_cast<std::uint16_t>(schemas_.size()))
      .Put(static_cast<std::uint32_t>(channels_.size()));
  content.Put(std::uint32_t{0}).Put(std::uint32_t{0});  // attachments, metadata
  content.Put(static_cast<std::uint32_t>(chunks_.size())).Put(start_ns_).Put(end_ns_);
  return Record(kStatistics, PutMap(content, counts_).text());
}

std::string McapWriter::Summary(std::uint64_t start, std::string& offsets) const {
  std::string all;
  const auto group = [&](std::uint8_t opcode, const std::string& records) {
    if (records.empty()) return;
    offsets += Record(
        kSummaryOffset,
        Content().Put(opcode).Put(start + all.size()).Put(static_cast<std::uint64_t>(records.size())).text());
    all += records;
  };
  std::string schemas, channels, chunks;
  for (const auto& content : schemas_) schemas += Record(kSchema, content);
  for (const auto& content : channels_) channels += Record(kChannel, content);
  for (const ChunkInfo& c : chunks_) {
    Content content;
    content.Put(c.start_ns).Put(c.end_ns).Put(c.offset).Put(c.bytes);
    PutMap(content, c.index_offsets).Put(c.index_bytes).Text("").Put(c.records_bytes).Put(c.records_bytes);
    chunks += Record(kChunkIndex, content.text());
  }
  group(kSchema, schemas);
  group(kChannel, channels);
  group(kStatistics, Statistics());
  group(kChunkIndex, chunks);
  return all;
}

void McapWriter::Finish() {
  EndChunk();
  WriteRecord(kDataEnd, Content().Put(data_crc_).text());
  const std::uint64_t summary_start = written_;
  std::string offsets;
  const std::string summary = Summary(summary_start, offsets);
  // The CRC of the summary runs up to and over the first fields of the footer.
  Content footer;
  footer.Put(summary_start).Put(summary_start + summary.size());
  constexpr std::uint64_t kFooterBytes = 20;
  const std::string opening =
      Content().Put(std::uint8_t{kFooter}).Put(kFooterBytes).Raw(footer.text()).text();
  const std::uint32_t crc = Crc32(0, summary + offsets + opening);
  footer.Put(crc);
  Write(summary);
  Write(offsets);
  WriteRecord(kFooter, footer.text());
  Write(kMcapMagic);
}

}  // namespace priamos::bus
