#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace priamos::bus {

/// Writes an MCAP file (https://mcap.dev/spec) of JSON messages: one JSON schema per type, so that the file
/// explains itself and Foxglove or Lichtblick open it. Chunked and indexed, not compressed; every CRC is
/// written. Times are nanoseconds.
class McapWriter {
 public:
  static constexpr std::size_t kChunkBytes = 1 << 20;

  explicit McapWriter(std::ostream& out);

  /// Returns the id of the schema or channel for the calls below.
  std::uint16_t AddSchema(std::string_view name, std::string_view json_schema);
  std::uint16_t AddChannel(std::string_view topic, std::uint16_t schema);
  void AddMessage(std::uint16_t channel, std::uint32_t sequence, std::uint64_t time_ns,
                  std::string_view json);
  /// Writes the summary; nothing may be added afterwards.
  void Finish();

 private:
  struct ChunkInfo {
    std::uint64_t start_ns, end_ns, offset, bytes, index_bytes, records_bytes;
    std::map<std::uint16_t, std::uint64_t> index_offsets;
  };
  void Write(std::string_view bytes);
  void WriteRecord(std::uint8_t opcode, std::string_view content);
  void EndChunk();
  void WriteIndexes(ChunkInfo& info);
  std::string Summary(std::uint64_t start, std::string& offsets) const;
  std::string Statistics() const;

  std::ostream& out_;
  std::uint64_t written_ = 0;
  std::uint32_t data_crc_ = 0;
  std::vector<std::string> schemas_, channels_;  ///< record contents, id - 1 is the index
  std::string chunk_;                            ///< records of the chunk that is being filled
  std::uint64_t chunk_start_ns_ = 0, chunk_end_ns_ = 0;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> chunk_index_;
  std::vector<ChunkInfo> chunks_;
  std::map<std::uint16_t, std::uint64_t> counts_;
  std::uint64_t messages_ = 0, start_ns_ = 0, end_ns_ = 0;
};

}  // namespace priamos::bus
