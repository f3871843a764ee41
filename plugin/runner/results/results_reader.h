// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "results/result_tables.h"

namespace nscdd {

/// Reads results.h5 in one process. Throws Error when the file is missing, incomplete or of a format that it does not know.
class ResultsReader {
 public:
  /// `folder` holds results.h5.
  explicit ResultsReader(const std::filesystem::path& folder);
  ~ResultsReader();

  const RunDescription& run() const { return run_; }
  /// Steps saved, ascending.
  const std::vector<std::int64_t>& steps() const { return steps_; }

  ShapeTable ReadShapes() const;
  StepDescription ReadStep(std::int64_t step) const;
  GrainTable ReadGrains(std::int64_t step) const;  ///< by ascending id
  ContactRows ReadContacts(std::int64_t step) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
  RunDescription run_;
  std::vector<std::int64_t> steps_;
};

}  // namespace nscdd
