// SPDX-License-Identifier: Apache-2.0
// Residuals and LMGC90's criteria against literal transcriptions of their formulas, on random problems and random states.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "nlgs/residual.h"
#include "nlgs/sweep.h"
#include "nscdd/contact_problem.h"
#include "sample_problem.h"

namespace nscdd {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Features {
  bool friction = true;
  bool arms = false;
  int subdomains = 1;
};

class RandomCase {
  std::mt19937 random_{3};  // first: the problem is made from it

 public:
  explicit RandomCase(const Features& f) : problem(Make(f)), sample(problem), velocity(problem.mass.size()) {
    for (std::size_t i = 0; i < velocity.size(); ++i) {
      velocity[i] = std::isinf(problem.mass[i]) ? problem.free_velocity[i] : Twist{Draw(-1, 1), Draw(-1, 1), Draw(-1, 1)};
    }
    for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
      const double rn = c % 4 == 0 ? 0.0 : Draw(-0.2, 1.0);  // not on the cone: a residual judges anything
      impulse.push_back({rn, f.friction ? Draw(-0.5, 0.5) : 0.0});
    }
    SetState();
  }

  double Draw(double low, double high) { return low + (high - low) * (random_() / 4294967296.0); }

  /// All copies of a body get its velocity; turning walls keep that of the touching point.
  void SetState() {
    const ContactModel model = sample.problem.model;
    for (const SubdomainProblem& p : sample.problem.subdomains) {
      SubdomainState s{p.free_velocity, {}};
      for (std::size_t b = 0; b < p.body_count(); ++b) {
        const Twist& v = velocity[p.body[b]];
        if (std::isinf(problem.mass[p.body[b]])) continue;
        const double entries[3] = {v.vx, v.vy, v.spin};
        std::copy_n(entries, Dofs(model), &s.velocity[Dofs(model) * b]);
      }
      for (const std::int32_t c : p.contact) {
        s.impulse.push_back(impulse[c].x);
        if (HasFriction(model)) s.impulse.push_back(impulse[c].y);
      }
      states.push_back(s);
    }
  }

  ContactProblem problem;
  test::Sample sample;
  std::vector<Twist> velocity;
  std::vector<Vec2> impulse;
  std::vector<SubdomainState> states;

 private:
  ContactProblem Make(const Features& f) {
    ContactProblem p;
    constexpr int kBodies = 12;
    for (int i = 0; i < kBodies; ++i) {
      const bool wall = i % 6 == 5;
      p.mass.push_back(wall ? kInfinity : Draw(0.5, 4.0));
      p.inertia.push_back(wall ? kInfinity : Draw(0.5, 4.0));
      p.free_velocity.push_back({Draw(-1, 1), Draw(-1, 1), wall && i < 6 ? 0.0 : Draw(-1, 1)});
      p.impulse.push_back({});
    }
    const auto pick = [&](int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); };
    for (int c = 0; c < 60; ++c) {
      const int a = pick(kBodies - 1), b = a + 1 + pick(kBodies - 1 - a);
      if (a % 6 == 5 && b % 6 == 5) continue;
      const double angle = Draw(0, 7);
      p.contacts.a.push_back(a);
      p.contacts.b.push_back(b);
      p.contacts.normal.push_back({std::cos(angle), std::sin(angle)});
      p.contacts.gap.push_back(0.0);
      p.contacts.lever_a.push_back(Draw(0.5, 2));
      p.contacts.lever_b.push_back(Draw(0.5, 2));
      p.contacts.friction.push_back(f.friction && c % 3 != 0 ? std::pow(10.0, Draw(-2, 2)) : 0.0);
      p.offset.push_back(Draw(-0.2, 0.2));
      p.subdomain.push_back(pick(f.subdomains));
      // Walls have arms in any case; free bodies only in clusters.
      const auto arm = [&](int body) { return f.arms || body % 6 == 5 ? Vec2{Draw(-1, 1), Draw(-1, 1)} : Vec2{}; };
      p.contacts.arm_a.push_back(arm(a));
      p.contacts.arm_b.push_back(arm(b));
    }
    return p;
  }
};

/// Columns n and t of H of one contact on one of its bodies: (x, y, turn).
struct Columns {
  std::array<double, 3> n, t;
};

Columns HOn(const ContactTable& table, std::size_t c, bool of_b) {
  const Vec2 n = table.normal[c], t{n.y, -n.x};
  const Vec2 arm = of_b ? table.arm_b[c] : table.arm_a[c];
  const Vec2 point = of_b ? arm - table.lever_b[c] * n : arm + table.lever_a[c] * n;
  const double sign = of_b ? 1.0 : -1.0;
  return {{sign * n.x, sign * n.y, sign * Cross(point, n)}, {sign * t.x, sign * t.y, sign * Cross(point, t)}};
}

double Product(const std::array<double, 3>& h, const std::array<double, 3>& m, const std::array<double, 3>& k) {
  return h[0] * m[0] * k[0] + h[1] * m[1] * k[1] + h[2] * m[2] * k[2];
}

/// v = H^T V and W = H^T M^-1 H of one contact from the definitions. Masses are divided by `share`.
struct Contact {
  double vn = 0, vt = 0, wnn = 0, wnt = 0, wtt = 0;
};

Contact Evaluate(const RandomCase& r, std::size_t c, double share_a = 1.0, double share_b = 1.0) {
  Contact out;
  const ContactProblem& p = r.problem;
  for (const bool of_b : {false, true}) {
    const Columns h = HOn(p.contacts, c, of_b);
    const int body = of_b ? p.contacts.b[c] : p.contacts.a[c];
    const double share = of_b ? share_b : share_a;
    const std::array<double, 3> v{r.velocity[body].vx, r.velocity[body].vy, r.velocity[body].spin}, one{1, 1, 1};
    const std::array<double, 3> m{share / p.mass[body], share / p.mass[body], share / p.inertia[body]};
    out.vn += Product(h.n, one, v);
    out.vt += Product(h.t, one, v);
    out.wnn += Product(h.n, m, h.n);
    out.wnt += Product(h.n, m, h.t);
    out.wtt += Product(h.t, m, h.t);
  }
  return out;
}

/// P_K of math: 4, written case by case.
Vec2 Project(double zn, double zt, double mu) {
  if (mu == 0.0) return {zn > 0.0 ? zn : 0.0, 0.0};
  if (std::fabs(zt) <= mu * zn) return {zn, zt};
  if (mu * std::fabs(zt) <= -zn) return {0.0, 0.0};
  const double n = (zn + mu * std::fabs(zt)) / (1.0 + mu * mu);
  return {n, (zt >= 0.0 ? 1.0 : -1.0) * mu * n};
}

struct Expected {
  double e2 = 0, r2 = 0, worst = 0, power = 0, load = 0;
  std::size_t worst_contact = 0;
};

Expected Literal(const RandomCase& r) {
  Expected out;
  for (std::size_t c = 0; c < r.problem.contacts.size(); ++c) {
    const Contact k = Evaluate(r, c);
    const double mu = r.problem.contacts.friction[c], b = r.problem.offset[c];
    const double rn = r.impulse[c].x, rt = r.impulse[c].y;
    const double rho = mu > 0.0 ? 1.0 / std::max(k.wnn, k.wtt) : 1.0 / k.wnn;
    const Vec2 p = mu > 0.0 ? Project(rn - rho * (k.vn + b + mu * std::fabs(k.vt)), rt - rho * k.vt, mu)
                            : Project(rn - rho * (k.vn + b), 0.0, 0.0);
    out.e2 += (rn - p.x) * (rn - p.x) + (rt - p.y) * (rt - p.y);
    out.r2 += rn * rn + rt * rt;
    const double u = k.vn + b, dissipated = rt * k.vt + mu * rn * std::fabs(k.vt);
    out.power += (u < 0.0 ? -u * std::max(rn, -u / k.wnn) : u * rn) + dissipated;
    out.load += rn * u + (std::fabs(rt) < mu * rn ? rt * k.vt : dissipated);
    const double en = std::fabs(std::min(k.vn + b, k.wnn * rn));
    const double bound = k.wtt * mu * std::max(rn, 0.0), z = k.wtt * rt - k.vt;
    const double et = std::fabs(k.wtt * rt - (z > bound ? bound : z < -bound ? -bound : z));
    const double error = std::max(en, et);
    if (error > out.worst) {
      out.worst = error;
      out.worst_contact = c;
    }
  }
  return out;
}

class Residual : public testing::TestWithParam<Features> {};

TEST_P(Residual, IsTheLiteralFormula) {
  RandomCase r(GetParam());
  ASSERT_EQ(HasFriction(r.sample.problem.model), GetParam().friction);
  ASSERT_EQ(HasArms(r.sample.problem.model), GetParam().arms);  // those of walls do not count
  const Expected expected = Literal(r);
  NaturalParts total;
  for (std::size_t e = 0; e < r.states.size(); ++e) {
    const NaturalParts part = NaturalResidual(r.sample.problem.subdomains[e], r.states[e]);
    total.sum_e2 += part.sum_e2;
    total.sum_r2 += part.sum_r2;
    total.sum_power += part.sum_power;
    total.sum_load += part.sum_load;
    if (part.worst > total.worst) {
      total.worst = part.worst;
      total.worst_contact = part.worst_contact;
    }
  }
  EXPECT_NEAR(total.sum_e2, expected.e2, 1e-12 * expected.e2);
  EXPECT_NEAR(total.sum_r2, expected.r2, 1e-12 * expected.r2);
  EXPECT_NEAR(total.sum_power, expected.power, 1e-12 * expected.power);
  EXPECT_NEAR(total.sum_load, expected.load, 1e-12 * expected.power);
  EXPECT_NEAR(total.worst, expected.worst, 1e-12 * expected.worst);
  EXPECT_EQ(total.worst_contact, static_cast<std::int64_t>(expected.worst_contact));
  const ResidualScales scales{3.0, 0.25, 1.0};
  EXPECT_NEAR(Nat(total.sum_e2, total.sum_r2, scales), std::sqrt(expected.e2 / expected.r2), 1e-12);
  EXPECT_NEAR(NatMax(total.worst, scales), expected.worst / 0.25, 1e-11);
}

TEST(ResidualScale, FloorsAndEmptyProblems) {
  EXPECT_EQ(Nat(4.0, 1e-12, {5000.0, 0.0, 0.0}), 2.0 / 5.0);  // 1e-3 |dt f| above |r|
  EXPECT_EQ(Nat(0.0, 0.0, {}), 0.0);
  EXPECT_EQ(NatMax(0.0, {}), 0.0);
  EXPECT_EQ(NatMax(0.1, {}), 0.0);  // no load, no approach
}

// LMGC90's measures of one sweep, from the impulses before and after and the diagonal blocks with the subdomains' masses.
TEST_P(Residual, CriteriaAreTheLiteralFormulas) {
  RandomCase r(GetParam());
  double na = 0, dv2 = 0, dv2_r2 = 0, rwr = 0, wr2 = 0, max_dv = 0, max_dvr = 0;
  SweepStatistics total;
  for (std::size_t e = 0; e < r.states.size(); ++e) {
    const SubdomainProblem& p = r.sample.problem.subdomains[e];
    const int unknowns = Unknowns(p.model);
    const std::vector<double> before = r.states[e].impulse;
    const SweepStatistics s = SweepWithStatistics(p, &r.states[e]);
    for (std::size_t k = 0; k < p.contact_count(); ++k) {
      const std::size_t c = p.contact[k];
      const auto share = [&](int body) { return std::max(1, r.sample.sharing.Multiplicity(body)); };
      const Contact w = Evaluate(r, c, share(r.problem.contacts.a[c]), share(r.problem.contacts.b[c]));
      const double wnt = HasArms(p.model) ? w.wnt : 0.0;
      const double* r0 = &before[unknowns * k];
      const double* r1 = &r.states[e].impulse[unknowns * k];
      const double r0t = unknowns == 2 ? r0[1] : 0.0, r1t = unknowns == 2 ? r1[1] : 0.0;
      const auto wr = [&](double n, double t) { return Vec2{w.wnn * n + wnt * t, unknowns == 2 ? wnt * n + w.wtt * t : 0.0}; };
      const Vec2 bar{0.5 * (r0[0] + r1[0]), 0.5 * (r0t + r1t)};
      if (bar.x == 0.0 && bar.y == 0.0) continue;
      const Vec2 dv = wr(r1[0] - r0[0], r1t - r0t), w0 = wr(r0[0], r0t), w1 = wr(r1[0], r1t);
      na += 1;
      dv2 += Dot(dv, dv);
      dv2_r2 += Dot(dv, dv) * Dot(bar, bar);
      rwr += 0.5 * (r0[0] * w0.x + r0t * w0.y + r1[0] * w1.x + r1t * w1.y);
      wr2 += 0.5 * (Dot(w0, w0) + Dot(w1, w1));
      max_dv = std::max(max_dv, Norm(dv));
      max_dvr = std::max(max_dvr, Norm(dv) * Norm(bar));
    }
    total.active += s.active;
    total.sum_dv2 += s.sum_dv2;
    total.sum_dv2_r2 += s.sum_dv2_r2;
    total.sum_rwr += s.sum_rwr;
    total.sum_wr2 += s.sum_wr2;
    total.max_dv = std::max(total.max_dv, s.max_dv);
    total.max_dv_r = std::max(total.max_dv_r, s.max_dv_r);
  }
  ASSERT_GT(na, 10);
  const double quad_wr = std::sqrt(wr2 / na), mean_wrr = rwr / na;
  const double quad = std::max(std::sqrt(dv2 / na) / quad_wr, std::sqrt(dv2_r2 / na) / mean_wrr);
  const double maxm = std::max(max_dv / quad_wr, max_dvr / mean_wrr);
  const StagnationMeasures m = Stagnation(total, {1.0, 1.0, 1e-3});
  EXPECT_NEAR(m.quad_wr, quad_wr, 1e-12 * quad_wr);
  EXPECT_NEAR(m.quad, quad, 1e-12 * quad);
  EXPECT_NEAR(m.maxm, maxm, 1e-12 * maxm);
  EXPECT_NEAR(m.qm16, std::max(quad, maxm / 16.666), 1e-12 * maxm);
}

INSTANTIATE_TEST_SUITE_P(Models, Residual,
                         testing::Values(Features{false, false, 1}, Features{false, false, 5}, Features{false, true, 4},
                                         Features{true, false, 1}, Features{true, false, 5}, Features{true, true, 1},
                                         Features{true, true, 6}));

TEST(Criteria, NothingActiveOrNegligibleCountsAsConverged) {
  SweepStatistics s;
  EXPECT_EQ(Stagnation(s, {1, 1, 1}).qm16, 0.0);
  s = {3, 1.0, 1.0, 1e-19, 1.0, 1.0, 1.0};
  EXPECT_EQ(Stagnation(s, {1, 1, 1.0}).qm16, 0.0);
  EXPECT_GT(Stagnation(s, {1, 1, 1e-4}).qm16, 0.0);  // the floor follows the loads
}

// One bad contact must not hide behind the good ones that follow it.
TEST(NotANumber, ReachesEveryMeasureAndNamesTheContact) {
  for (const bool friction : {false, true}) {
    for (const bool in_velocity : {false, true}) {
      RandomCase r({.friction = friction});
      const std::size_t contact = r.problem.contacts.size() / 2;
      const SubdomainProblem& p = r.sample.problem.subdomains.front();
      SubdomainState& s = r.states.front();
      if (in_velocity) {
        s.velocity[Dofs(p.model) * (friction ? p.friction[contact].a : p.normal[contact].a)] = kNan;
      } else {
        s.impulse[Unknowns(p.model) * contact] = kNan;
      }
      const NaturalParts part = NaturalResidual(p, s);
      EXPECT_TRUE(std::isnan(Nat(part.sum_e2, part.sum_r2, {1, 1, 1})));
      EXPECT_TRUE(std::isnan(NatMax(part.worst, {1, 1, 1})));
      if (!in_velocity) {
        EXPECT_EQ(part.worst_contact, p.contact[contact]);
      }
    }
  }
}

// Impulses whose squares overflow once made the relative residual vanish.
TEST(Nat, AnOverflowIsNoSmallResidual) {
  const ResidualScales scales{1.0, 1.0, 1.0};
  EXPECT_TRUE(std::isnan(Nat(1e300, INFINITY, scales)));
  EXPECT_TRUE(std::isnan(Nat(INFINITY, INFINITY, scales)));
  EXPECT_EQ(Nat(4.0, 16.0, scales), 0.5);
}

}  // namespace
}  // namespace nscdd
