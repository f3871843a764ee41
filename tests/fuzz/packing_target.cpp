// SPDX-License-Identifier: Apache-2.0
// Tables of disks.

#include <cmath>

#include "scene/disk_file.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nscdd;
  static const fuzz::ScratchFolder folder;
  const auto path = folder.Write("disks.csv", data, size);
  fuzz::Accepts([&] {
    std::size_t rows = 0, skipped = 0;
    DiskFileReader reader(path);
    for (DiskRow row; reader.Next(&row); ++rows) {
      const bool sound = std::isfinite(row.pose.x + row.pose.y + row.pose.angle) || !std::isfinite(row.pose.x + row.pose.y);
      if (!sound || !(row.radius > 0.0) || !std::isfinite(row.radius) || row.id.value_or(0) < 0)
        fuzz::Fail("an impossible disk");
    }
    reader.Remarks();
    for (DiskFileReader again(path); again.Skip();) ++skipped;
    if (skipped != rows) fuzz::Fail("rows that are skipped are not those that are read");
  });
  return 0;
}
