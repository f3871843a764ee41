// SPDX-License-Identifier: Apache-2.0
// The exact solution of one contact: the law holds to rounding, for any friction, with and without coupling W_nt.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "nlgs/local_solve.h"

namespace nscdd {
namespace {

struct Draw {
  std::mt19937 random{5};
  double operator()(double low, double high) { return low + (high - low) * (random() / 4294967296.0); }
};

/// 0 <= v_n + b _|_ r_n >= 0 and Coulomb, relative to the sizes at play.
void ExpectLaw(const Delassus& w, double offset, double mu, Local q, Local r) {
  const double un = w.nn * r.n + w.nt * r.t + q.n + offset, vt = w.nt * r.n + w.tt * r.t + q.t;
  const double velocity = 1e-12 * (std::abs(q.n) + std::abs(q.t) + std::abs(offset)) * (1.0 + mu);
  const double impulse = velocity / std::min(w.nn, w.tt);
  EXPECT_GE(r.n, 0.0);
  EXPECT_GE(un, -velocity);
  EXPECT_LE(std::abs(r.n * un), velocity * (r.n + impulse) + impulse * std::abs(un));
  EXPECT_LE(std::abs(r.t), mu * r.n + impulse);
  if (std::abs(vt) > velocity * 100) {
    EXPECT_NEAR(r.t, -mu * r.n * (vt > 0 ? 1.0 : -1.0), impulse * 100) << "vt " << vt;
  }
}

TEST(LocalSolve, DiskWithFriction) {
  Draw draw;
  int open = 0, stick = 0, slide = 0;
  for (int k = 0; k < 20000; ++k) {
    const double mu = std::pow(10.0, draw(-3, 3)) * (k % 5 != 0);
    const Delassus w{draw(0.1, 3), 0.0, draw(0.1, 3)};
    FrictionRow c{};
    c.inverse_wnn = 1.0 / w.nn;
    c.inverse_wtt = 1.0 / w.tt;
    c.offset = draw(-0.1, 0.1);
    c.friction = mu;
    const Local old{draw(0, 1), draw(-1, 1)}, v{draw(-1, 1), draw(-1, 1)};
    const Local q{v.n - w.nn * old.n, v.t - w.tt * old.t};
    const Local r = SolveLocal(c, old, v);
    ExpectLaw(w, c.offset, mu, q, r);
    ++(r.n == 0.0 ? open : std::abs(r.t) < mu * r.n ? stick : slide);
  }
  EXPECT_GT(std::min({open, stick, slide}), 1000);
}

TEST(LocalSolve, ClusterWithCoupling) {
  Draw draw;
  int open = 0, stick = 0, slide = 0;
  for (int k = 0; k < 20000; ++k) {
    const Delassus w{draw(0.5, 2), draw(-0.4, 0.4), draw(0.5, 2)};
    FrictionArmsRow c{};
    c.wnn = w.nn;
    c.wnt = w.nt;
    c.wtt = w.tt;
    c.offset = draw(-0.1, 0.1);
    c.friction = draw(0.0, 0.9 * w.nn / std::abs(w.nt));
    ASSERT_FALSE(IsPainleve(c));
    const Local old{draw(0, 1), draw(-1, 1)}, v{draw(-1, 1), draw(-1, 1)};
    const Local q{v.n - w.nn * old.n - w.nt * old.t, v.t - w.nt * old.n - w.tt * old.t};
    const Local r = SolveLocal(c, old, v);
    ExpectLaw(w, c.offset, c.friction, q, r);
    ++(r.n == 0.0 ? open : std::abs(r.t) < c.friction * r.n * (1 - 1e-12) ? stick : slide);
  }
  EXPECT_GT(std::min({open, stick, slide}), 1000);
}

// Rounding may put an impulse on the cone's edge outside of stick and of slide alike; the loaded contact must not open for
// that.
TEST(LocalSolve, ClusterOnTheEdgeOfTheCone) {
  Draw draw;
  for (int k = 0; k < 20000; ++k) {
    FrictionArmsRow c{};
    c.wnn = draw(0.5, 2);
    c.wnt = draw(-0.4, 0.4);
    c.wtt = draw(0.5, 2);
    c.friction = draw(0.05, 0.9);
    const Local edge{1.0, (k % 2 == 0 ? 1.0 : -1.0) * c.friction};
    const Local v{-c.wnn * edge.n - c.wnt * edge.t, -c.wnt * edge.n - c.wtt * edge.t};
    const Local r = SolveLocal(c, {}, v);
    ASSERT_NEAR(r.n, edge.n, 1e-12);
    ASSERT_NEAR(r.t, edge.t, 1e-12);
  }
}

TEST(LocalSolve, CouplingVanishesContinuously) {
  FrictionRow disk{};
  disk.inverse_wnn = 0.5;
  disk.inverse_wtt = 0.25;
  disk.friction = 0.3;
  FrictionArmsRow cluster{};
  cluster.wnn = 2.0;
  cluster.wtt = 4.0;
  cluster.friction = 0.3;
  for (const Local v : {Local{-1, 0.1}, Local{-1, 3}, Local{-1, -3}, Local{1, 1}}) {
    const Local a = SolveLocal(disk, {}, v), b = SolveLocal(cluster, {}, v);
    EXPECT_NEAR(a.n, b.n, 1e-15);
    EXPECT_NEAR(a.t, b.t, 1e-15);
  }
}

}  // namespace
}  // namespace nscdd
