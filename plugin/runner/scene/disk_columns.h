// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nscdd {

/// What a column of a table of disks means.
enum class DiskColumn { kId, kX, kY, kZ, kRadius, kDiameter, kAngle, kVx, kVy, kSpin, kMaterial, kKind, kUnused };

/// The columns of one table, in its order.
struct DiskColumns {
  std::vector<DiskColumn> meaning;
  std::vector<std::string> unused;  ///< names of those that nothing is read from
  std::string fault;                ///< what is wrong and how to mend it, without full stop; empty: nothing

  bool Has(DiskColumn column) const;
};

/// The documented name of a column, such as "radius".
std::string_view NameOf(DiskColumn column);

/// Columns by their names: the documented ones or, where one of these is not there, what other programs call it. Capitals, '_'
/// and other signs in names do not count. At fault unless x, y and a radius or diameter are there, each once.
DiskColumns ColumnsNamed(const std::vector<std::string_view>& names);

/// Columns without names: 3 are x, y, radius; 4 are x, y, z, radius. Other counts are at fault.
DiskColumns ColumnsByPosition(std::size_t count);

}  // namespace nscdd
