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

/// When an iteration stops.
struct StoppingOptions {
  Criterion criterion = Criterion::kNat;
  double tolerance = 1e-4;       ///< [-] of the criterion; 0: iterate up to max_iterations
  int max_iterations = 10000;    ///< sweeps (NSCD) or interface updates (NSCDD)
  int test_every = 5;            ///< iterations between two tests; a test costs about one sweep
  int stall_iterations = 20000;  ///< "stalled" when the residual has found no new minimum for so many iterations
};

/// The normal law is 0 <= v_n + b_n _|_ r_n >= 0; this chooses the offset b_n [m/s].
enum class NormalLaw {
  kGap,       ///< b_n = max(0, gap) / dt
  kStrict,    ///< contacts with gap > 0 do not exist; b_n = 0
  kFeedback,  ///< b_n = max(0, gap) / dt - min(cap, beta max(0, -(gap + slop)) / dt): undoes interpenetration
};

/// Moreau-Jean scheme and contact law.
struct SteppingOptions {
  double theta = 0.5;            ///< [-] in [1/2, 1]; contacts are detected at q + (1 - theta) dt V
  double alert_distance = -1.0;  ///< [m] pairs with a larger gap are no candidates; < 0: a tenth of the mean disk radius
  NormalLaw normal_law = NormalLaw::kGap;
  double feedback_beta = 0.05;   ///< [-] part of the interpenetration that one step undoes
  double feedback_slop = 0.0;    ///< [m] interpenetration that is left alone
  double feedback_cap = 1e300;   ///< [m/s] largest recovery speed
  bool warm_start = true;        ///< impulses of the previous step, by contact key; interface impulses by (body, subdomain)
};

/// Grid of subdomains over the mobile bodies' centres.
struct PartitionOptions {
  int nx = 1;
  int ny = 1;
  int repartition_every = 1;  ///< steps between two placements of the cuts
};

/// NonSmooth Contact Dynamics: one subdomain, NLGS sweeps. Reference solver of the paper.
struct NscdOptions {
  StoppingOptions stopping;
};

/// NSCDD, the paper's Algorithm 1: sweeps in each subdomain, then the mean velocity of the copies of each interface body.
struct NscddOptions {
  StoppingOptions stopping;
  PartitionOptions partition;
  int sweeps_per_stage = 1;  ///< n_GS
};

using AlgorithmOptions = std::variant<NscdOptions, NscddOptions>;

}  // namespace nscdd
