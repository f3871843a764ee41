// SPDX-License-Identifier: Apache-2.0
#include "scene/grain_size.h"

namespace nscdd {
namespace {

/// Number of disks of a source and the sum of their radii.
struct Sum {
  double count = 0.0;
  double radii = 0.0;
};

struct SourceSum {
  double bodies;

  Sum operator()(const StateBodies& state) const {
    return state.mean_radius > 0.0 ? Sum{bodies, bodies * state.mean_radius} : Sum{};
  }
  Sum operator()(const SingleDisk& disk) const { return {1.0, disk.radius}; }
  Sum operator()(const DiskFile& file) const { return {static_cast<double>(file.free), file.free_radii}; }
  Sum operator()(const Lattice& lattice) const { return {bodies, bodies * 0.5 * (lattice.min_radius + lattice.max_radius)}; }
  Sum operator()(const Deposition& bed) const { return {bodies, bodies * 0.5 * (bed.min_radius + bed.max_radius)}; }
  Sum operator()(const Cluster& cluster) const {
    Sum sum{bodies * static_cast<double>(cluster.disks.size()), 0.0};
    for (const reference::Disk& disk : cluster.disks) sum.radii += bodies * disk.radius;
    return sum;
  }
  Sum operator()(const Wall&) const { return {}; }
};

}  // namespace

double MeanGrainRadius(const Scene& scene) {
  Sum total;
  for (const BodySource& source : scene.bodies) {
    if (source.kind != BodyKind::kFree && !std::holds_alternative<DiskFile>(source.what)) continue;
    const Sum sum = std::visit(SourceSum{static_cast<double>(source.count)}, source.what);
    total.count += sum.count;
    total.radii += sum.radii;
  }
  return total.radii / total.count;
}

}  // namespace nscdd
