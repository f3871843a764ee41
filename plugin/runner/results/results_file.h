// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "results/file_extent.h"
#include "results/result_tables.h"
#include "results/results_folder.h"

namespace nscdd {

/// results.h5 and results.xdmf (for ParaView): what the bodies and contacts were at the steps saved, 0 being the initial state.
/// Schema: README.md. Several ranks write one file in parallel (MPI-IO), each its own rows.
///
/// A kill while HDF5 writes may spoil the file. A run with checkpoints therefore writes segments: Keep() closes the present
/// one, which is never touched again, and Close() copies them into one file.
class ResultsFile {
 public:
  enum class Mode { kWhole, kSegments };
  /// Collective. Keeps a reference to `folder`. `shapes` of the bodies that this rank owns.
  /// Throws Error on all ranks when the file cannot be written.
  ResultsFile(ResultsFolder* folder, const RunDescription& run, const ShapeTable& shapes, Mode mode = Mode::kWhole);
  /// Goes on behind the segments that an earlier ResultsFile handed out by Keep().
  ResultsFile(ResultsFolder* folder, const RunDescription& run, const ShapeTable& shapes, const std::vector<FileExtent>& kept);
  ~ResultsFile();

  /// Collective. Adds a step, later than those before; on disk when it returns.
  void Save(const StepDescription& step, const GrainTable& grains, const ContactRows& contacts);
  /// Collective; of segments. Brings all steps saved to the disk; rank 0 gets what a continuation begins from.
  std::vector<FileExtent> Keep();
  /// Collective; writes results.xdmf; before ResultsFolder::Finish().
  void Close();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nscdd
