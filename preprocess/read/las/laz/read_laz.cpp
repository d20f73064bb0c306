#include "preprocess/read/las/laz/read_laz.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "preprocess/read/las/laz/laz_chunks.h"
#include "preprocess/read/las/laz/laz_decoder.h"
#include "preprocess/read/las/laz/laz_layout.h"

namespace splatray {
namespace {

/// More points for each byte than scans have. Chunks that claim more get memory only as they turn out to hold them.
constexpr std::uint64_t MOST_POINTS_PER_BYTE = 1;

bool is_plausible(const LazChunk& chunk) { return chunk.points / MOST_POINTS_PER_BYTE <= chunk.bytes; }

/// A decoder and room for some of its records: what a thread needs.
struct Worker {
  std::unique_ptr<LazDecoder> decoder;
  std::vector<unsigned char> records;
  std::size_t most_records;

  Worker(const LazLayout& layout, const std::vector<bool>& wanted)
      : decoder(make_laz_decoder(layout, wanted)) {
    constexpr std::size_t CACHED_BYTES = std::size_t{1} << 15U;
    most_records = std::max<std::size_t>(1, CACHED_BYTES / layout.record_bytes);
    records.resize(most_records * layout.record_bytes);
  }
};

void add(LasColumns::Filled& to, const LasColumns::Filled& more) {
  to.kept += more.kept;
  to.withheld += more.withheld;
  to.noise += more.noise;
}

/// A chunk in memory, and what became of it.
struct Loaded {
  LazChunk chunk;
  std::span<const unsigned char> bytes;
  std::size_t at = 0;      ///< of its first point in the columns
  std::size_t points = 0;  ///< decoded; none of a chunk that is not whole
  LasColumns::Filled filled{};
};

/// Decodes so many points of a chunk, or those that it says it has, into the room that it has.
void decode(Loaded& loaded, std::size_t points, Worker& worker, LasColumns& columns) {
  LazDecoder& decoder = *worker.decoder;
  points = decoder.start(loaded.bytes, points);
  loaded.filled = {};
  bool is_whole = points > 0;
  for (std::size_t left = points; is_whole && left > 0;) {
    const std::size_t step = std::min(left, worker.most_records);
    decoder.read(worker.records.data(), step);
    add(loaded.filled, columns.fill(worker.records.data(), step, loaded.at + loaded.filled.kept));
    left -= step;
    is_whole = !decoder.is_damaged();
  }
  is_whole = is_whole && (loaded.chunk.is_last || decoder.is_complete());
  loaded.points = is_whole ? points : 0;
  if (!is_whole) loaded.filled = {};
}

/// Decodes a chunk; the last may have fewer points than the header counts.
void decode(Loaded& loaded, Worker& worker, LasColumns& columns) {
  const auto claimed = static_cast<std::size_t>(loaded.chunk.points);
  decode(loaded, claimed, worker, columns);
  if (loaded.points > 0 || !loaded.chunk.is_last) return;
  const std::size_t there = points_there(*worker.decoder, loaded.bytes, claimed, worker.records.data());
  if (there > 0) decode(loaded, there, worker, columns);
}

class LazReader {
 public:
  LazReader(ByteReader& in, const LasHeader& header, const LazLayout& layout, LasColumns& columns,
            ScanCounts& counts, const ReadListener& listener)
      : in_(in),
        header_(header),
        layout_(layout),
        columns_(columns),
        counts_(counts),
        listener_(listener),
        workers_([&layout, wanted = columns.used_bytes()] { return Worker(layout, wanted); }) {}

  std::uint64_t read(const std::vector<LazChunk>& chunks) {
    expected_ = 0;
    std::uint64_t bytes = 0;
    for (const LazChunk& chunk : chunks) {
      expected_ += chunk.points;
      bytes += chunk.bytes;
    }
    columns_.reserve(static_cast<std::size_t>(std::min(expected_, bytes * MOST_POINTS_PER_BYTE)));
    read_chunks(chunks);
    return decoded_;
  }

  std::uint64_t read_all() {
    in_.seek(0);
    const std::uint64_t bytes = in_.remaining() - header_.points_offset;
    columns_.reserve(static_cast<std::size_t>(std::min(header_.point_count, bytes * MOST_POINTS_PER_BYTE)));
    if (const auto chunks = find_laz_chunks(in_, header_, layout_)) {
      read_chunks(*chunks);
    } else if (layout_.has_equal_chunks || !layout_.is_chunked) {
      read_in_a_row();
    } else {
      throw_unreadable(in_.path(), "found no table of its chunks, expected one, as they differ in size");
    }
    return decoded_;
  }

 private:
  void read_chunks(std::span<const LazChunk> chunks) {
    const std::size_t threads =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    const std::uint64_t enough_bytes = std::max<std::uint64_t>(8, 2 * threads) << 20U;
    // Whoever watches sees the first points soon.
    for (std::uint64_t most_bytes = std::uint64_t{1} << 20U; !chunks.empty();
         most_bytes = std::min(2 * most_bytes, enough_bytes)) {
      std::size_t count = 0;
      for (std::uint64_t bytes = 0;
           count < chunks.size() && is_plausible(chunks[count]) && bytes < most_bytes; ++count)
        bytes += chunks[count].bytes;
      if (count > 0) {
        read_together(chunks.first(count));
      } else {
        count = 1;
        static_cast<void>(read_alone(chunks.front()));
      }
      chunks = chunks.subspan(count);
    }
  }

  /// Decodes chunks in parallel.
  void read_together(std::span<const LazChunk> chunks) {
    report();
    const std::vector<std::size_t> begins = load(chunks);
    std::vector<Loaded> all;
    for (std::size_t i = 0; i < chunks.size(); ++i)
      all.push_back({chunks[i],
                     std::span(bytes_).subspan(begins[i], static_cast<std::size_t>(chunks[i].bytes)),
                     columns_.grow(static_cast<std::size_t>(chunks[i].points))});
    tbb::parallel_for(std::size_t{0}, all.size(),
                      [&](std::size_t i) { decode(all[i], workers_.local(), columns_); });
    std::size_t end = all.front().at;
    for (const Loaded& loaded : all) {
      columns_.move(loaded.at, loaded.filled.kept, end);
      end += loaded.filled.kept;
      count(loaded.points, loaded.filled);
    }
    columns_.cut(end);
    listener_.show(columns_.points());
  }

  /// Where the bytes of points end at the latest.
  [[nodiscard]] std::uint64_t points_end() {
    in_.seek(0);
    const bool has_more = header_.evlr_offset > header_.points_offset;
    return has_more ? std::min(header_.evlr_offset, in_.remaining()) : in_.remaining();
  }

  /// Chunks without a table, each from where the last one ends, until one is not whole: files with chunks have a table unless they are
  /// cut off, within a chunk.
  void read_in_a_row() {
    const std::uint64_t end = points_end();
    LazChunk chunk{first_laz_chunk(header_, layout_), 0, 0, !layout_.is_chunked};
    for (std::uint64_t left = header_.point_count; left > 0 && chunk.offset < end; left -= chunk.points) {
      chunk.points = layout_.is_chunked ? std::min<std::uint64_t>(left, layout_.chunk_points) : left;
      // No coder needs more.
      const std::uint64_t most_point_bytes = 3 * layout_.record_bytes + 64;
      chunk.bytes = std::min(end - chunk.offset, chunk.points * most_point_bytes);
      const std::uint64_t consumed = read_alone(chunk);
      if (consumed == 0) return;
      chunk.offset += consumed;
    }
  }

  /// Decodes a chunk that may not hold what it claims. Returns the bytes that it took, 0 where it is not whole and thus left out;
  /// the last may have fewer points.
  std::uint64_t read_alone(const LazChunk& chunk) {
    load(chunk.offset, chunk.bytes);
    const auto claimed = static_cast<std::size_t>(chunk.points);
    const std::uint64_t consumed = decode_alone(claimed);
    if (consumed > 0 || !chunk.is_last) return consumed;
    Worker& worker = workers_.local();
    const std::size_t there = points_there(*worker.decoder, bytes_, claimed, worker.records.data());
    return there > 0 ? decode_alone(there) : 0;
  }

  /// Decodes so many points of the bytes that are loaded; room is made as they come. Returns the bytes that they took, 0 where they
  /// are damaged.
  std::uint64_t decode_alone(std::size_t points) {
    Worker& worker = workers_.local();
    const std::size_t begin = columns_.size();
    LasColumns::Filled filled;
    points = worker.decoder->start(bytes_, points);
    bool is_whole = points > 0;
    for (std::size_t left = points; is_whole && left > 0;) {
      report();
      const std::size_t step = std::min(left, worker.most_records);
      worker.decoder->read(worker.records.data(), step);
      const std::size_t at = columns_.grow(step);
      add(filled, columns_.fill(worker.records.data(), step, at));
      columns_.cut(begin + filled.kept);
      left -= step;
      is_whole = !worker.decoder->is_damaged();
    }
    if (!is_whole) {
      columns_.cut(begin);
      return 0;
    }
    count(points, filled);
    return worker.decoder->consumed();
  }

  /// Loads chunks, those that follow one another in one go; returns where each begins in `bytes_`.
  std::vector<std::size_t> load(std::span<const LazChunk> chunks) {
    std::vector<std::size_t> begins;
    std::vector<ByteReader::Range> ranges;
    std::uint64_t bytes = 0;
    for (const LazChunk& chunk : chunks) {
      begins.push_back(static_cast<std::size_t>(bytes));
      bytes += chunk.bytes;
      if (!ranges.empty() && ranges.back().offset + ranges.back().count == chunk.offset)
        ranges.back().count += chunk.bytes;
      else
        ranges.push_back({chunk.offset, chunk.bytes});
    }
    bytes_ = in_.read(ranges);
    return begins;
  }

  void load(std::uint64_t offset, std::uint64_t count) {
    if (in_.offset() != offset) in_.seek(offset);
    bytes_ = in_.read(count);
  }

  void count(std::uint64_t points, const LasColumns::Filled& filled) {
    decoded_ += points;
    counts_.withheld += filled.withheld;
    counts_.noise += filled.noise;
  }

  void report() { listener_.report(static_cast<double>(decoded_) / static_cast<double>(expected_)); }

  ByteReader& in_;
  const LasHeader& header_;
  const LazLayout& layout_;
  LasColumns& columns_;
  ScanCounts& counts_;
  const ReadListener& listener_;
  tbb::enumerable_thread_specific<Worker> workers_;
  std::vector<unsigned char> bytes_;
  std::uint64_t decoded_ = 0, expected_ = header_.point_count;
};

}  // namespace

std::uint64_t read_laz_points(ByteReader& in, const LasHeader& header, std::span<const unsigned char> record,
                              const std::optional<std::vector<LazChunk>>& chosen, LasColumns& columns,
                              ScanCounts& counts, const ReadListener& listener) {
  const LazLayout layout = read_laz_layout(record, header, in.path());
  if (header.point_count == 0) return 0;
  LazReader reader(in, header, layout, columns, counts, listener);
  return chosen ? reader.read(*chosen) : reader.read_all();
}

}  // namespace splatray
