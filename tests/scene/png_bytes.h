// png_bytes.h: PNG files made in code, with uncompressed deflate blocks. 8 or 16 bits a channel.
#pragma once

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <cstdint>
#include <string_view>
#include <vector>

namespace ninefold {

inline void appendWord(std::vector<unsigned char>& to, uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8)
    to.push_back(static_cast<unsigned char>(word >> shift));
}

inline void appendChunk(std::vector<unsigned char>& to, std::string_view type,
                        const std::vector<unsigned char>& body) {
  appendWord(to, static_cast<uint32_t>(body.size()));
  const size_t start = to.size();
  to.insert(to.end(), type.begin(), type.end());
  to.insert(to.end(), body.begin(), body.end());
  boost::crc_32_type crc;
  crc.process_bytes(&to[start], to.size() - start);
  appendWord(to, crc.checksum());
}

// The begin of a PNG: its header.
inline std::vector<unsigned char> pngHeader(uint32_t width, uint32_t height, int channels,
                                            int bits) {
  constexpr std::array<unsigned char, 5> kColourType = {0, 0, 4, 2, 6};
  std::vector<unsigned char> file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  std::vector<unsigned char> header;
  appendWord(header, width), appendWord(header, height);
  header.push_back(static_cast<unsigned char>(bits));
  header.push_back(kColourType[static_cast<size_t>(channels)]);
  for (int i = 0; i < 3; ++i) header.push_back(0);  // the only compression, filter and interlace
  appendChunk(file, "IHDR", header);
  return file;
}

// A PNG that claims a size but has no pixels.
inline std::vector<unsigned char> emptyPng(uint32_t width, uint32_t height, int channels) {
  auto file = pngHeader(width, height, channels, 8);
  appendChunk(file, "IDAT", {});
  appendChunk(file, "IEND", {});
  return file;
}

// `samples`: rows top to bottom, big-endian if 16 bits; less than 64 KiB.
inline std::vector<unsigned char> png(int width, int height, int channels,
                                      const std::vector<unsigned char>& samples, int bits = 8) {
  auto file =
      pngHeader(static_cast<uint32_t>(width), static_cast<uint32_t>(height), channels, bits);
  const size_t row = static_cast<size_t>(width * channels * bits / 8);
  std::vector<unsigned char> raw((row + 1) * static_cast<size_t>(height), 0);  // no prediction
  for (size_t y = 0; y < static_cast<size_t>(height); ++y)
    std::copy_n(samples.begin() + static_cast<ptrdiff_t>(row * y), row,
                raw.begin() + static_cast<ptrdiff_t>((row + 1) * y + 1));
  uint32_t a = 1, b = 0;
  for (const unsigned char c : raw) a = (a + c) % 65521, b = (b + a) % 65521;
  const auto size = static_cast<uint32_t>(raw.size());
  std::vector<unsigned char> body = {0x78, 0x01, 0x01};
  for (const uint32_t half : {size, ~size})
    for (const int shift : {0, 8}) body.push_back(static_cast<unsigned char>(half >> shift));
  body.insert(body.end(), raw.begin(), raw.end());
  appendWord(body, b << 16 | a);
  appendChunk(file, "IDAT", body);
  appendChunk(file, "IEND", {});
  return file;
}

}  // namespace ninefold
