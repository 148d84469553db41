// How many double- or single-precision operations an x86-64 vector instruction does: additions,
// multiplications, minima, maxima, divisions, roots and estimates count one in each lane, fused multiply-adds
// two; comparisons, moves and bit operations none. Encodings: Intel SDM volume 2, sections 2.3 (VEX) and 2.7
// (EVEX).
#pragma once
#include <cstdint>

namespace freshet::perf {

struct Encoding {
  bool vector = false;  // VEX or EVEX
  int map = 0, pp = 0, opcode = 0;
  bool wide = false;  // W
  int bits = 128;
};

inline Encoding encoding_of(const std::uint8_t* b) {
  if (b[0] == 0xc5) return {true, 1, b[1] & 3, b[2], false, b[1] & 4 ? 256 : 128};
  if (b[0] == 0xc4) return {true, b[1] & 31, b[2] & 3, b[3], (b[2] & 0x80) != 0, b[2] & 4 ? 256 : 128};
  if (b[0] == 0x62) return {true, b[1] & 7, b[2] & 3, b[4], (b[2] & 0x80) != 0, 128 << (b[3] >> 5 & 3)};
  return {};
}

inline int flops_of(const std::uint8_t* bytes) {
  const Encoding e = encoding_of(bytes);
  if (!e.vector) return 0;
  if (e.map == 1) {
    const bool arithmetic =
        e.opcode == 0x51 || e.opcode == 0x58 || e.opcode == 0x59 || (e.opcode >= 0x5c && e.opcode <= 0x5f);
    if (!arithmetic) return 0;
    return e.pp >= 2 ? 1 : e.bits / (e.pp == 1 ? 64 : 32);  // pp: 0 floats, 1 doubles, 2 and 3 one of them
  }
  if (e.map != 2) return 0;
  const int lanes = e.bits / (e.wide ? 64 : 32), low = e.opcode & 15, high = e.opcode >> 4;
  if (e.opcode == 0x4e || e.opcode == 0x4c) return lanes;  // vrsqrt14p, vrcp14p
  const bool fused = (high == 9 || high == 10 || high == 11) && low >= 6;
  if (!fused) return 0;
  return 2 * (low > 7 && low % 2 == 1 ? 1 : lanes);
}

}  // namespace freshet::perf
