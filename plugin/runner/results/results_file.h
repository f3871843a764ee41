#pragma once

#include <memory>
#include <vector>

#include "results/result_tables.h"
#include "results/results_folder.h"

namespace nscdd {

/// results.h5 and results.xdmf (for ParaView): what the bodies and contacts were at the steps saved. Schema: README.md.
/// Several ranks write one file in parallel (MPI-IO), each its own rows.
class ResultsFile {
 public:
  /// Collective. Keeps a reference to `folder`. `shapes` of the bodies that this rank owns.
  /// Throws Error on all ranks when the file cannot be written.
  ResultsFile(ResultsFolder* folder, const RunDescription& run, const ShapeTable& shapes);
  ~ResultsFile();

  /// Collective. Adds a step, later than those before; on disk when it returns.
  void Save(const StepDescription& step, const GrainTable& grains, const ContactRows& contacts);
  /// Collective; writes results.xdmf; before ResultsFolder::Finish().
  void Close();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nscdd
