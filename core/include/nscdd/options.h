// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

namespace nscdd {

/// What "converged" means. Definitions: core/src/nlgs/residual.h.
enum class Criterion {
  kNat,     ///< natural residual of the global problem, relative to |r| (default)
  kNatMax,  ///< worst contact, in velocity units of max |f| dt / m (g dt under gravity)
  kQuad,    ///< LMGC90's 'Quad': quadratic means of what one sweep changed
  kMaxm,    ///< LMGC90's 'Maxm': maxima of what one sweep changed
  kQm16,    ///< LMGC90's 'QM/16': Quad, and maxima below 16.666 times the tolerance
};

// Names, limits and help of the options: option_table.h.

/// When an iteration stops.
struct StoppingOptions {
  Criterion criterion = Criterion::kNat;
  double tolerance = 1e-4;       ///< [-] of the criterion; 0: make max_iterations iterations, status "fixed"
  int max_iterations = 10000;    ///< sweeps (NSCD) or interface updates (NSCDD)
  int test_every = 5;            ///< iterations between two tests; one costs about a sweep, and serves the acceleration
  int stall_iterations = 20000;  ///< "stalled" when the residual has found no new minimum for so many iterations
};

/// The normal law is 0 <= v_n + b_n _|_ r_n >= 0; this chooses the offset b_n [m/s], and how many stages a step has.
enum class NormalLaw {
  kImpact,    ///< two stages: displacements that keep the bodies apart, then velocities that rebound (core/README.md)
  kGap,       ///< the paper's one stage, and so are the next two: b_n = max(0, gap) / dt
  kStrict,    ///< contacts with gap > 0 do not exist; b_n = 0
  kFeedback,  ///< b_n = max(0, gap) / dt - min(cap, beta max(0, -(gap + slop)) / dt): undoes interpenetration
};

/// Time stepping and contact law.
struct SteppingOptions {
  double theta = 0.5;            ///< [-] of the laws of one stage: contacts are detected at q + (1 - theta) dt V
  double alert_distance = -1.0;  ///< [m] pairs with a larger gap are no candidates, unless they may meet in the step (kImpact);
                                 ///< < 0: a tenth of the mean disk radius
  NormalLaw normal_law = NormalLaw::kGap;
  double feedback_beta = 0.05;  ///< [-] part of the interpenetration that one step undoes
  double feedback_slop = 0.0;   ///< [m] interpenetration that is left alone
  double feedback_cap = 1e300;  ///< [m/s] largest recovery speed
  bool warm_start = true;       ///< impulses of the previous step, by contact key; interface impulses by (body, subdomain)
};

/// Grid of subdomains over the mobile bodies' centres.
struct PartitionOptions {
  int nx = 1;
  int ny = 1;
  int repartition_every = 1;  ///< steps between two placements of the cuts
};

/// What makes the fixed point of an iteration converge in fewer of them.
enum class Acceleration {
  kNone,      ///< the plain iteration of the paper
  kAnderson,  ///< Anderson's: combines the last iterates (default)
};

/// Extrapolation of the iterates.
struct AccelerationOptions {
  Acceleration method = Acceleration::kAnderson;
  int depth = 5;  ///< iterates before the last that are combined
  int every = 1;  ///< iterations between two extrapolations
};

/// NonSmooth Contact Dynamics: one subdomain, NLGS sweeps. Reference solver of the paper.
struct NscdOptions {
  StoppingOptions stopping;
  AccelerationOptions acceleration;
};

/// NSCDD, the paper's Algorithm 1: sweeps in each subdomain, then the mean velocity of the copies of each interface body.
struct NscddOptions {
  StoppingOptions stopping;
  PartitionOptions partition;
  int sweeps_per_stage = 1;  ///< n_GS
  AccelerationOptions acceleration;
};

/// Columns of G, the contacts that the linear interface problem sees: active ones (r_n > 0), their
enum class Compatibility {
  kNormal,    ///< normals (the paper's G', default)
  kFull,      ///< normals and tangents (G)
  kSticking,  ///< normals, and tangents of sticking contacts
};

/// Columns whose v_E enters the right-hand side (the status stage), where they differ from those of the matrix: tangents
/// outside are taken at rest, v_t = 0. The paper allows for different operators in the two.
enum class StatusCompatibility { kSame, kNormal, kSticking };

/// Which v_E enters the search direction (r~ - r) + Lambda (v~ - v) = 0.
enum class LocalVelocity {
  kLocal,    ///< what each local solve of the last sweep left: -b_n on active normals
  kCurrent,  ///< G^T V_E after the sweep
};

/// What lambda multiplies.
enum class LambdaScale {
  kMass,     ///< one reference mass
  kContact,  ///< 1 / W_nn of each contact (undivided masses)
};

enum class InterfaceSolve {
  kDirect,  ///< assembled primal matrix M + Lambda G G^T, factorised
  kCg,      ///< conjugate gradient on X_lambda (Algorithms 5 and 6), neighbours only
};

enum class Preconditioner { kNone, kDiagonal, kLumped, kDirichlet };

enum class LinearLibrary { kAuto, kEigen, kMumps };

/// The augmented interface problem  X_lambda F = sum_E A_E M_lambda,E^-1 y_E.
struct AugmentedInterfaceOptions {
  double lambda = 10.0;  ///< [-] search direction over the reference mass; 0: the plain interface of NSCDD
  Compatibility compatibility = Compatibility::kNormal;
  StatusCompatibility status_compatibility = StatusCompatibility::kSame;
  LocalVelocity local_velocity = LocalVelocity::kLocal;
  LambdaScale lambda_scale = LambdaScale::kMass;
  double reference_mass = 0.0;  ///< [kg] 0: mean mass of the free bodies
  double restoring = 0.0;       ///< [-] part of the interpenetration that the linear problem alone asks to undo in a step: its
                           ///< search direction becomes (r~ - r) + Lambda (v~ - v - restoring max(0, -gap) / dt) = 0 on normals
  InterfaceSolve solve = InterfaceSolve::kDirect;
  LinearLibrary linear_solver = LinearLibrary::kAuto;
  Preconditioner preconditioner = Preconditioner::kLumped;
  double cg_tolerance = 1e-4;  ///< [-] fall of the jump of the augmented velocities in one update
  int cg_max_iterations = 2000;
};

/// Fully enriched algorithm, Algorithm 2: NSCDD with the augmented interface in stage 2.
struct FeaOptions {
  StoppingOptions stopping;
  PartitionOptions partition;
  int sweeps_per_stage = 5;  ///< n_GS
  AugmentedInterfaceOptions interface;
  AccelerationOptions acceleration;
  bool jump_guard = true;  ///< plain updates for a while where the jump of the copies has more than doubled
};

/// Relaxed enriched algorithm, Algorithm 3: iterates like FEA until the interface alone converges, then in each subdomain with
/// the interface impulses frozen.
struct ReaOptions {
  StoppingOptions stopping;  ///< of the subdomains; its tolerance is also that of the relative jump
  PartitionOptions partition;
  int sweeps_per_stage = 5;
  int max_interface_updates = 2000;
  AugmentedInterfaceOptions interface;
};

/// Incomplete enriched algorithm, Algorithm 4: one sweep for the status of the contacts, one interface solve, then each
/// subdomain by itself. What remains at the interface is reported, and may be reduced by the last two options.
struct IeaOptions {
  StoppingOptions stopping;  ///< of the subdomains; max_iterations is the cap on their sweeps
  PartitionOptions partition;
  AugmentedInterfaceOptions interface;
  int polish_sweeps = 0;    ///< closing sweeps of the contacts of interface bodies, mean velocity between two
  int closing_updates = 0;  ///< closing iterations of NSCDD ("hybrid")
};

/// High accuracy with friction: interior point iterations, and as many plain sweeps beside them, on one subdomain. An iteration
/// is a factorisation of a matrix of the size of all bodies, and a sweep; the criterion is nat or nat_max.
struct NewtonOptions {
  StoppingOptions stopping{Criterion::kNat, 1e-6, 2000, 1, 450};
  LinearLibrary linear_solver = LinearLibrary::kAuto;  ///< kAuto: block LU without pivoting; the others as a cross-check
};

using AlgorithmOptions = std::variant<NscdOptions, NscddOptions, FeaOptions, ReaOptions, IeaOptions, NewtonOptions>;

/// Whether an algorithm works on several subdomains.
inline bool HasPartition(const AlgorithmOptions& algorithm) {
  return std::visit(
      [](const auto& o) {
        return requires { o.partition; };
      },
      algorithm);
}

/// The subdomains that an algorithm works on: one, where it knows no others.
inline PartitionOptions PartitionOf(const AlgorithmOptions& algorithm) {
  return std::visit(
      [](const auto& o) {
        if constexpr (requires { o.partition; }) {
          return o.partition;
        } else {
          return PartitionOptions{};
        }
      },
      algorithm);
}

}  // namespace nscdd
