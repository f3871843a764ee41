// SPDX-License-Identifier: Apache-2.0
// CSV files of disks.

#include <cmath>

#include "scene/disk_file.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nscdd;
  static const fuzz::ScratchFolder folder;
  const auto path = folder.Write("disks.csv", data, size);
  fuzz::Accepts([&] {
    DiskFileReader reader(path);
    for (DiskRow row; reader.Next(&row);) {
      const bool sound = std::isfinite(row.pose.x + row.pose.y + row.pose.angle) || !std::isfinite(row.pose.x + row.pose.y);
      if (!sound || !(row.radius > 0.0) || !std::isfinite(row.radius) || row.id.value_or(0) < 0)
        fuzz::Fail("an impossible disk");
    }
  });
  return 0;
}
