#include "preprocess/read/tiles/zstandard.h"

#include <zstd.h>

#include <algorithm>
#include <memory>
#include <string>

#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {

std::vector<unsigned char> read_zstandard(const std::filesystem::path& path, std::uint64_t most) {
  ByteReader file(path);
  const std::vector<unsigned char> packed = file.read(file.remaining());
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                          ZSTD_freeDStream);
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  std::vector<unsigned char> bytes;
  ZSTD_outBuffer out{nullptr, 0, 0};
  std::size_t wanted = 1;  // how much more the frame needs, 0 at its end
  while (in.pos < in.size || (wanted != 0 && out.pos == out.size)) {
    if (out.pos == out.size) {
      if (bytes.size() > most)
        throw_unreadable(path, "found more than " + std::to_string(most) +
                                   " bytes when it is unpacked, expected what the hierarchy counts");
      bytes.resize(std::min<std::uint64_t>(std::max(2 * bytes.size(), ZSTD_DStreamOutSize()), most + 1));
      out.dst = bytes.data();
      out.size = bytes.size();
    }
    wanted = ZSTD_decompressStream(stream.get(), &out, &in);
    if (ZSTD_isError(wanted) != 0)
      throw_unreadable(path, std::string("found a damaged Zstandard frame (") + ZSTD_getErrorName(wanted) +
                                 "), expected a whole one");
  }
  if (wanted != 0)
    throw_unreadable(path, "found a Zstandard frame that ends in its middle, expected a whole one");
  bytes.resize(out.pos);
  return bytes;
}

}  // namespace splatray
