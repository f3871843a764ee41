// SPDX-License-Identifier: Apache-2.0
#include "results/results_copy.h"

#include <fmt/format.h>

#include <string>

#include "results/hdf5_file.h"
#include "results/staged_file.h"

namespace nscdd {

void CopyResultsFile(const std::filesystem::path& from, const std::filesystem::path& to, std::optional<std::int64_t> dropped) {
  const Hdf5Silence silence;
  StagedFile(to).Close();
  CheckSpace(to, std::filesystem::file_size(from));
  const Hdf5File whole = Hdf5File::Open(from);
  Hdf5File copy = Hdf5File::Create(to, RankGroup());
  const std::string steps = "steps", unwanted = dropped ? fmt::format("{:06}", *dropped) : "";
  for (const std::string& name : whole.Names(whole.OpenGroup("/"))) {
    if (name != steps) copy.Copy(whole, "/" + name);
  }
  copy.CreateGroup("/" + steps);
  for (const std::string& name : whole.Names(whole.OpenGroup("/" + steps))) {
    if (name != unwanted) copy.Copy(whole, "/" + steps + "/" + name);
  }
  copy.Close();
}

}  // namespace nscdd
