// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "interface/gluing.h"
#include "nscdd/communicator.h"
#include "nscdd/options.h"
#include "nscdd/report.h"
#include "problem/partitioned_problem.h"

namespace nscdd {

/// Anderson acceleration (type II; Walker and Ni 2011) of the fixed point s -> g(s) that an iteration is, on the state
///     s = (r_E, F_E)   with   <a, b> = sum W_nn a_n b_n + W_tt a_t b_t + M~_E^-1 a_F b_F      (energies)
/// F is accelerated with r: r alone, beside the F that belongs to another r, gains nothing. With f = g - s and the differences
/// df, dg of successive f and g, at most `depth` of them,
///     next s = g - sum c_i dg_i,   c = argmin |f - sum c_i df_i|,   r then clipped to |r_t| <= mu r_n, r_n >= 0
/// Safeguards: where |f| has grown the differences are forgotten and next s = g; and sum |c_i| |dg_i| <= reach |f|, or impulses
/// grow along self-stresses, which no velocity sees. The swept state g is what is measured and returned.
///
/// Sweeps carry a load to the ground slowly: after a test the next start is multiplied by 1 - S (residual.h), the maximum of
/// the dual energy along r. Whatever the start, (s, g) is one more pair of the history.
class Anderson {
 public:
  static constexpr int kMaxDepth = 8;

  /// Nothing is allocated, and Extrapolate() does nothing, without acceleration. Keeps references.
  Anderson(const PartitionedProblem& problem, const AccelerationOptions& options, const Gluing* gluing,
           Communicator* communicator, const PartitionedState& start);

  /// After iteration `iteration` (from 1), every options.every of them: `state` becomes the start of the next one. Collective,
  /// one reduction of depth + 3 numbers. `scale` multiplies the start.
  void Extrapolate(int iteration, PartitionedState* state, double scale = 1.0);

  /// Adds its work to the report.
  SolveReport Close(SolveReport report) const;

 private:
  /// Of the newest df: <df, df_i> with itself and the older ones, <df, f>; <f, f>; and <dg, dg> of the newest dg.
  struct Products {
    std::array<double, kMaxDepth> df_df;
    double df_f, f_f, dg_dg;
  };

  /// Of free bodies in contact, not divided [kg, 1/kg].
  struct Masses {
    double largest, largest_inverse;
  };

  /// One subdomain's vectors, of size n = impulses and interface impulses.
  struct Part {
    std::vector<std::int32_t> copies;  // of the subdomain, in the interface map
    Masses masses{};
    std::vector<double> weight;
    std::vector<double> start;        // s
    std::vector<double> residual;     // f
    std::vector<double> weighted;     // weight df
    std::vector<double> images;       // g, ring of depth + 1
    std::vector<double> differences;  // df, ring of depth
  };

  void MakePart(std::size_t e);
  void Pack(std::size_t e, const PartitionedState& state, double* out) const;
  void Unpack(std::size_t e, PartitionedState* state) const;
  Products TakeImage(const PartitionedState& state);
  void Keep(const Products& products);
  std::vector<double> Coefficients() const;
  void Combine(Part* part, const std::vector<double>& c) const;
  void Restart();
  int Slot(int age) const { return (newest_ + depth_ - age) % depth_; }  // of df
  int ImageSlot(int age) const { return (image_ + depth_ + 1 - age) % (depth_ + 1); }

  const PartitionedProblem& problem_;
  const Gluing* gluing_;
  Communicator* communicator_;
  int depth_ = 0;
  int every_ = 1;
  std::vector<Part> parts_;
  bool has_residual_ = false;
  int count_ = 0;                                                // differences kept
  int newest_ = 0;                                               // slot of the newest df
  int image_ = 0;                                                // slot of the newest g
  double reach_ = 0.0;                                           // of an extrapolation, in |f|
  double norm2_ = 0.0;                                           // <f, f>
  std::array<double, kMaxDepth> moments_{};                      // <f, df> by slot
  std::array<double, kMaxDepth> length_{};                       // |dg| by slot
  std::array<std::array<double, kMaxDepth>, kMaxDepth> gram_{};  // <df, df> by slots
  std::int64_t extrapolations_ = 0, restarts_ = 0;
};

}  // namespace nscdd
