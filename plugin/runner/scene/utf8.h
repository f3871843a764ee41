#pragma once

#include <string_view>

namespace nscdd {

/// Line (from 1) of the first byte that is not UTF-8 (RFC 3629); 0 if all are.
int FirstLineOutsideUtf8(std::string_view text);

}  // namespace nscdd
