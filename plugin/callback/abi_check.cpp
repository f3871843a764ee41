// SPDX-License-Identifier: Apache-2.0
#include "nscdd/callback/abi_check.h"

#include <fmt/format.h>

#include "nscdd/error.h"

namespace nscdd {

void CheckAbiHeader(const nscdd_header& header, std::size_t size, const char* structure) {
  if (header.abi_major != NSCDD_ABI_MAJOR) {
    throw Error(
        fmt::format("{}: its header says ABI major {}, this solver speaks major {}; rebuild one side with the other's "
                    "nscdd_plugin.h, and set header = {{sizeof, NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR}}",
                    structure, header.abi_major, NSCDD_ABI_MAJOR));
  }
  if (header.abi_minor > NSCDD_ABI_MINOR) {
    throw Error(fmt::format("{}: its header says ABI {}.{}, this solver knows only {}.{}; load a newer solver plugin",
                            structure, header.abi_major, header.abi_minor, NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR));
  }
  if (header.struct_size < size) {
    throw Error(
        fmt::format("{}: its header says {} bytes, ABI {}.{} prescribes at least {}; set header.struct_size = sizeof({})",
                    structure, header.struct_size, header.abi_major, header.abi_minor, size, structure));
  }
}

}  // namespace nscdd
