// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "nscdd_plugin.h"

namespace nscdd {

/// Compares the first member of a structure that came over the C interface with what this library was built for, before
/// anything behind it is read. Throws Error when the major differs, when the writer's minor is newer than ours, or when
/// struct_size is below `size`, which its minor prescribes.
void CheckAbiHeader(const nscdd_header& header, std::size_t size, const char* structure);

/// Size that a host's table of this minor has at least [bytes]: it has grown.
inline std::size_t HostSize(std::uint32_t abi_minor) {
  return abi_minor < 3 ? offsetof(nscdd_host, sweep_contacts) : sizeof(nscdd_host);
}

/// Header of a structure of `size` bytes that we write.
inline nscdd_header MakeAbiHeader(std::size_t size) { return {size, NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR}; }

}  // namespace nscdd
