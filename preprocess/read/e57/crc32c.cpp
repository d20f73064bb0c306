#include "preprocess/read/e57/crc32c.h"

#include <array>
#include <cstring>

namespace splatray {
namespace {

constexpr std::uint32_t POLYNOMIAL = 0x82F63B78;  ///< 0x1EDC6F41 with its bits reversed

using Tables = std::array<std::array<std::uint32_t, 256>, 8>;

/// tables[k][b]: what byte b does to the checksum when k zero bytes follow it.
constexpr Tables make_tables() {
  Tables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? POLYNOMIAL : 0U);
    tables[0][byte] = crc;
  }
  for (std::size_t k = 1; k < tables.size(); ++k)
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = tables[k - 1][byte];
      tables[k][byte] = (before >> 8U) ^ tables[0][before & 0xFFU];
    }
  return tables;
}

constexpr Tables TABLES = make_tables();

}  // namespace

std::uint32_t crc32c(const unsigned char* bytes, std::size_t size) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (; size >= 8; bytes += 8, size -= 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, sizeof word);
    word ^= crc;
    crc = TABLES[7][word & 0xFFU] ^ TABLES[6][word >> 8U & 0xFFU] ^ TABLES[5][word >> 16U & 0xFFU] ^
          TABLES[4][word >> 24U & 0xFFU] ^ TABLES[3][word >> 32U & 0xFFU] ^ TABLES[2][word >> 40U & 0xFFU] ^
          TABLES[1][word >> 48U & 0xFFU] ^ TABLES[0][word >> 56U];
  }
  for (; size > 0; ++bytes, --size) crc = (crc >> 8U) ^ TABLES[0][(crc ^ *bytes) & 0xFFU];
  return ~crc;
}

}  // namespace splatray
