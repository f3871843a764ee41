// SPDX-License-Identifier: Apache-2.0
// Reads an FCLib file with libfclib, solves it with a solver of Siconos and compares with the answer in the file.
//     siconos_check FILE.h5 nsgs|lemke TOLERANCE MAX_ITERATIONS
// and prints one line of JSON. Knows nothing of nscdd: residual and velocities are computed here from W, q, M, H, f, w, mu.

extern "C" {
#include <fclib.h>
}
#include <siconos/numerics/FrictionContactProblem.h>
#include <siconos/numerics/Friction_cst.h>
#include <siconos/numerics/NonSmoothDrivers.h>
#include <siconos/numerics/NumericsMatrix.h>
#include <siconos/numerics/SolverOptions.h>
#include <siconos/numerics/SparseBlockMatrix.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace {

using Vector = std::vector<double>;

/// y += A x, or A^T x.
void AddProduct(const fclib_matrix& a, const double* x, Vector* y) {
  for (int c = 0; c < a.n; ++c) {
    for (int k = a.p[c]; k < a.p[c + 1]; ++k) (*y)[a.i[k]] += a.x[k] * x[c];
  }
}
void AddTransposedProduct(const fclib_matrix& a, const double* x, Vector* y) {
  for (int c = 0; c < a.n; ++c) {
    for (int k = a.p[c]; k < a.p[c + 1]; ++k) (*y)[c] += a.x[k] * x[a.i[k]];
  }
}

/// What both halves of the file must say alike: W r + q = H^T M^-1 (f + H r) + w for any r. Largest difference over largest
/// entry.
double Disagreement(const fclib_global& g, const fclib_local& l) {
  const int n = g.H->m, m = l.W->m;
  Vector r(m), p(g.f, g.f + n), global(g.w, g.w + m), local(l.q, l.q + m);
  for (int i = 0; i < m; ++i) r[i] = std::sin(1.0 + i);
  AddProduct(*g.H, r.data(), &p);
  for (int i = 0; i < n; ++i) p[i] /= g.M->x[i];
  AddTransposedProduct(*g.H, p.data(), &global);
  AddProduct(*l.W, r.data(), &local);
  double difference = 0.0, largest = 0.0;
  for (int i = 0; i < m; ++i) {
    difference = std::max(difference, std::abs(global[i] - local[i]));
    largest = std::max(largest, std::abs(local[i]));
  }
  return difference / largest;
}

/// V = M^-1 (f + H r).
Vector Velocities(const fclib_global& g, const double* r) {
  Vector v(g.f, g.f + g.H->m);
  AddProduct(*g.H, r, &v);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] /= g.M->x[i];
  return v;
}

/// Natural residual over |r|: r - P(r - rho (u + mu |u_t| n)), rho = 1 / max(W_nn, W_tt) of the contact (1 / W_nn without
/// friction).
double NaturalResidual(const fclib_local& l, const double* r) {
  Vector u(l.q, l.q + l.W->m), diagonal(l.W->m, 0.0);
  AddProduct(*l.W, r, &u);
  for (int c = 0; c < l.W->n; ++c) {
    for (int k = l.W->p[c]; k < l.W->p[c + 1]; ++k) diagonal[c] += l.W->i[k] == c ? l.W->x[k] : 0.0;
  }
  double e2 = 0.0, r2 = 0.0;
  for (int c = 0; 2 * c < l.W->n; ++c) {
    const double mu = l.mu[c], rn = r[2 * c], rt = r[2 * c + 1];
    const double rho = 1.0 / (mu > 0.0 ? std::max(diagonal[2 * c], diagonal[2 * c + 1]) : diagonal[2 * c]);
    const double zn = rn - rho * (u[2 * c] + mu * std::abs(u[2 * c + 1])), zt = mu > 0.0 ? rt - rho * u[2 * c + 1] : 0.0;
    double pn = 0.0, pt = 0.0;
    if (mu == 0.0) {
      pn = std::max(0.0, zn);
    } else if (std::abs(zt) <= mu * zn) {
      pn = zn;
      pt = zt;
    } else if (mu * std::abs(zt) > -zn) {
      pn = (zn + mu * std::abs(zt)) / (1.0 + mu * mu);
      pt = std::copysign(mu * pn, zt);
    }
    e2 += (rn - pn) * (rn - pn) + (rt - pt) * (rt - pt);
    r2 += rn * rn + rt * rt;
  }
  return std::sqrt(e2 / r2);
}

/// |V - V'|_M / |V' - V_f|_M: the difference of two answers against all that contacts do.
double EnergyDistance(const fclib_global& g, const Vector& a, const Vector& b) {
  double difference = 0.0, total = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double m = g.M->x[i], d = a[i] - b[i], t = b[i] - g.f[i] / m;
    difference += m * d * d;
    total += m * t * t;
  }
  return std::sqrt(difference / total);
}

NumericsMatrix* Dense(const fclib_matrix& w) {
  NumericsMatrix* m = NM_create(NM_DENSE, w.m, w.n);
  for (int c = 0; c < w.n; ++c) {
    for (int k = w.p[c]; k < w.p[c + 1]; ++k) m->matrix0[w.i[k] + static_cast<std::size_t>(c) * w.m] += w.x[k];
  }
  return m;
}

/// Blocks of 2 x 2, one per pair of contacts that share a body.
NumericsMatrix* Blocks(const fclib_matrix& w) {
  std::vector<std::map<unsigned, std::vector<double>>> rows(w.m / 2);
  for (int c = 0; c < w.n; ++c) {
    for (int k = w.p[c]; k < w.p[c + 1]; ++k) {
      auto& block = rows[w.i[k] / 2].try_emplace(c / 2, 4, 0.0).first->second;
      block[w.i[k] % 2 + 2 * (c % 2)] = w.x[k];
    }
  }
  NumericsMatrix* m = NM_create(NM_SPARSE_BLOCK, w.m, w.n);
  SparseBlockStructuredMatrix* s = m->matrix1;
  const auto array = [](std::size_t count, std::size_t size) { return std::calloc(count, size); };
  s->blocknumber0 = s->blocknumber1 = rows.size();
  s->blocksize0 = static_cast<unsigned*>(array(rows.size(), sizeof(unsigned)));
  s->blocksize1 = static_cast<unsigned*>(array(rows.size(), sizeof(unsigned)));
  s->index1_data = static_cast<std::size_t*>(array(rows.size() + 1, sizeof(std::size_t)));
  std::size_t count = 0;
  for (const auto& row : rows) count += row.size();
  s->nbblocks = count;
  s->filled1 = rows.size() + 1;
  s->filled2 = count;
  s->index2_data = static_cast<std::size_t*>(array(count, sizeof(std::size_t)));
  s->block = static_cast<double**>(array(count, sizeof(double*)));
  count = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    s->blocksize0[i] = s->blocksize1[i] = 2 * (i + 1);
    for (const auto& [column, block] : rows[i]) {
      s->index2_data[count] = column;
      s->block[count] = static_cast<double*>(std::malloc(4 * sizeof(double)));
      std::memcpy(s->block[count++], block.data(), 4 * sizeof(double));
    }
    s->index1_data[i + 1] = count;
  }
  return m;
}

int SolverId(const std::string& name) {
  if (name == "nsgs") return SICONOS_FRICTION_2D_NSGS;
  if (name == "lemke") return SICONOS_FRICTION_2D_LEMKE;
  std::fprintf(stderr, "siconos_check: no solver '%s'; take nsgs or lemke\n", name.c_str());
  std::exit(2);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: siconos_check FILE.h5 nsgs|lemke TOLERANCE MAX_ITERATIONS\n");
    return 2;
  }
  const int solver = SolverId(argv[2]);
  fclib_global* global = fclib_read_global(argv[1]);
  fclib_local* local = fclib_read_local(argv[1]);
  int guesses = 0;
  fclib_solution* answer = fclib_read_guesses(argv[1], &guesses);
  const bool converged = answer == nullptr || guesses == 0;
  if (converged) answer = fclib_read_solution(argv[1]);
  if (global == nullptr || local == nullptr || answer == nullptr) return 2;

  NumericsMatrix* w = solver == SICONOS_FRICTION_2D_NSGS ? Blocks(*local->W) : Dense(*local->W);
  const int contacts = local->W->m / 2;
  FrictionContactProblem* problem = frictionContactProblem_new_with_data(2, contacts, w, local->q, local->mu);
  SolverOptions* options = solver_options_create(solver);
  options->dparam[SICONOS_DPARAM_TOL] = std::atof(argv[3]);
  options->iparam[SICONOS_IPARAM_MAX_ITER] = std::atoi(argv[4]);
  Vector r(2 * contacts, 0.0), u(2 * contacts, 0.0);
  const int info = fc2d_driver(problem, r.data(), u.data(), options);

  const Vector ours(answer->v, answer->v + global->M->m), theirs = Velocities(*global, r.data());
  std::printf(
      "{\"contacts\": %d, \"title\": \"%s\", \"converged\": %s, \"halves\": %.3g, \"siconos_info\": %d, "
      "\"siconos_iterations\": %d, "
      "\"nat_siconos\": %.3g, \"nat_ours\": %.3g, \"balance_ours\": %.3g, \"velocity_distance\": %.3g}\n",
      contacts, global->info->title, converged ? "true" : "false", Disagreement(*global, *local), info,
      options->iparam[SICONOS_IPARAM_ITER_DONE], NaturalResidual(*local, r.data()), NaturalResidual(*local, answer->r),
      EnergyDistance(*global, ours, Velocities(*global, answer->r)), EnergyDistance(*global, ours, theirs));
  std::fflush(stdout);
  std::_Exit(0);  // neither library frees all that it gives: no check for leaks
}
