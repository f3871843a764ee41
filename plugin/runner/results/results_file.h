// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "results/rank_group.h"
#include "results/result_tables.h"
#include "results/results_folder.h"
#include "results/run_files.h"

namespace nscdd {

/// What the bodies of this rank look like in a saved state, in global axes.
struct PlacedShapes {
  GrainTable
      disks;        ///< a row for each disk of each body: that of the body, with the disk's centre, its velocity and its radius
  LineTable walls;  ///< segments, half-planes (as long as the sample), outlines of disks with prescribed motion
};

/// Collective. `grains` are the bodies that this rank owns now, `shapes` those of any bodies, in whatever way the ranks share
/// them. `mean_radius` [m] of the free bodies decides how fine outlines are.
PlacedShapes PlaceShapes(const GrainTable& grains, const ShapeTable& shapes, double mean_radius, const RankGroup& ranks);

/// The lines from the centre of A's disk to that of B's, of each contact; from or to the point on a side without disk.
LineTable ChainsOf(const ContactRows& contacts);

/// A step in results.h5, as ParaView is told of it.
struct XdmfStep {
  std::string group;  ///< for instance /steps/000050
  double time = 0.0;
  bool has_disks = false;    ///< grains are drawn from the table "disks", not "grains"
  std::uint64_t grains = 0;  ///< points
  std::uint64_t contacts = 0;
  std::uint64_t walls = 0;  ///< lines
  std::uint64_t wall_points = 0;
};

/// The text of results.xdmf: collections in time of points "grains" and "contacts" and of lines "chains" and "walls", with the
/// columns as attributes.
std::string FormatXdmf(const std::vector<XdmfStep>& steps);

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

/// Copies all that is in a results.h5, but for the root's attributes and the step `dropped`, into a new file: a segment that
/// ResultsFile goes on behind. By one process. Throws Error when the one cannot be read or the other not be written.
void CopyResultsFile(const std::filesystem::path& from, const std::filesystem::path& to, std::optional<std::int64_t> dropped);

}  // namespace nscdd
