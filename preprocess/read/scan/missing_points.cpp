#include "preprocess/read/scan/missing_points.h"

#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {

void report_missing(const std::filesystem::path& path, const ScanCounts& counts, const ScanOptions& options,
                    const ReadListener& listener) {
  if (counts.missing == 0) return;
  const std::string found = "found " + std::to_string(counts.stored - counts.missing) + " points, expected " +
                            std::to_string(counts.stored) + " as the file says";
  if (options.strict) throw_unreadable(path, found);
  listener.note(path, found + "; those there are were read");
}

}  // namespace splatray
