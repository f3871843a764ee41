// SPDX-License-Identifier: Apache-2.0
#include "nlgs/packet_sweep.h"

namespace nscdd {

template <class Row>
PacketSweep<Row> PacketSweepHere() {
#ifdef NSCDD_PACKETS_AVX2
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (has_avx2) return SweepPacketsAvx2;
#endif
  return nullptr;
}

template PacketSweep<NormalRow> PacketSweepHere<NormalRow>();
template PacketSweep<FrictionRow> PacketSweepHere<FrictionRow>();

}  // namespace nscdd
