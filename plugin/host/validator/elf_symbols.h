// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace nscdd {

/// Names of the symbols that the 64-bit ELF shared library `path` defines for others, sorted. Throws Error if it is none.
std::vector<std::string> ExportedSymbols(const std::string& path);

}  // namespace nscdd
