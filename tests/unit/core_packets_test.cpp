// SPDX-License-Identifier: Apache-2.0
// Contacts in packets: who may be solved at once, and that solving four at once leaves the bits of the plain loop.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <vector>

#include "nlgs/packet_sweep.h"
#include "nlgs/sweep.h"
#include "problem/packet_order.h"

namespace nscdd {
namespace {

struct Draw {
  std::mt19937 random{7};
  double operator()(double low, double high) { return low + (high - low) * (random() / 4294967296.0); }
  std::int32_t Below(std::int32_t n) { return static_cast<std::int32_t>(random() % n); }
};

/// Bodies 0, 1, ... of inverse mass 1, every seventh prescribed; contacts between any two of which one is free.
struct Graph {
  std::vector<double> inverse_mass;
  std::vector<std::int32_t> a, b, all;

  Graph(std::int32_t bodies, int contacts, Draw* draw) : all(contacts) {
    for (std::int32_t i = 0; i < bodies; ++i) inverse_mass.push_back(i % 7 == 0 ? 0.0 : 1.0);
    while (static_cast<int>(a.size()) < contacts) {
      const std::int32_t first = draw->Below(bodies), second = draw->Below(bodies);
      if (first == second || (first % 7 == 0 && second % 7 == 0)) continue;
      a.push_back(std::min(first, second));
      b.push_back(std::max(first, second));
    }
    std::iota(all.begin(), all.end(), 0);
  }

  bool IsFree(std::int32_t body) const { return inverse_mass[body] > 0.0; }
};

TEST(PacketOrder, KeepsTheOrderOfEachBodyAndSharesNoFreeBody) {
  Draw draw;
  for (int contacts : {0, 1, 7, 8, 9, 200, 3000}) {
    const Graph graph(2 + contacts / 2, contacts, &draw);
    PacketScheduler scheduler(graph.inverse_mass);
    scheduler.Order(graph.all, graph.a, graph.b);  // leaves nothing behind
    const PacketOrder order = scheduler.Order(graph.all, graph.a, graph.b);

    ASSERT_EQ(order.contact.size(), graph.all.size());
    ASSERT_EQ(order.begin.back(), contacts);
    std::map<std::int32_t, std::int32_t> last;  // contact of each body, so far
    std::vector<int> seen(contacts);
    for (std::size_t p = 0; p + 1 < order.begin.size(); ++p) {
      ASSERT_LE(order.begin[p + 1] - order.begin[p], kPacketSize);
      ASSERT_GT(order.begin[p + 1], order.begin[p]);
      std::map<std::int32_t, int> touched;
      for (std::int32_t k = order.begin[p]; k < order.begin[p + 1]; ++k) {
        const std::int32_t c = order.contact[k];
        ++seen[c];
        for (const std::int32_t body : {graph.a[c], graph.b[c]}) {
          if (!graph.IsFree(body)) continue;
          EXPECT_EQ(++touched[body], 1) << "body " << body << " twice in packet " << p;
          if (last.contains(body)) EXPECT_LT(last[body], c) << "contacts of body " << body;
          last[body] = c;
        }
      }
    }
    EXPECT_EQ(std::accumulate(seen.begin(), seen.end(), 0), contacts);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), contacts);
  }
}

TEST(PacketOrder, FillsPacketsWhereContactsAreIndependentAndNotInAChain) {
  std::vector<double> inverse_mass(200, 1.0);
  std::vector<std::int32_t> a, b, all;
  for (std::int32_t k = 0; k < 100; ++k) {
    a.push_back(2 * k);
    b.push_back(2 * k + 1);
    all.push_back(k);
  }
  PacketScheduler scheduler(inverse_mass);
  EXPECT_EQ(scheduler.Order(all, a, b).begin.size(), 14U);  // 12 of 8, one of 4
  for (std::int32_t k = 0; k < 100; ++k) a[k] = k, b[k] = k + 1;
  EXPECT_EQ(scheduler.Order(all, a, b).begin.size(), 101U);
}

FrictionRow RandomRow(Draw* draw, FrictionRow) {
  const double angle = (*draw)(0, 6.3);
  FrictionRow row{};
  row.n = {std::cos(angle), std::sin(angle)};
  row.turn_ta = (*draw)(-1, 0);
  row.turn_tb = (*draw)(0, 1);
  row.inverse_wnn = (*draw)(0.2, 1);
  row.inverse_wtt = (*draw)(0.1, 0.5);
  row.offset = (*draw)(-0.1, 0.3);
  row.friction = draw->Below(3) == 0 ? 0.0 : (*draw)(0, 1);
  return row;
}

NormalRow RandomRow(Draw* draw, NormalRow) {
  const FrictionRow row = RandomRow(draw, FrictionRow{});
  return {0, 0, row.n, row.inverse_wnn, row.offset};
}

template <class Row>
SubdomainProblem RandomProblem(Draw* draw, int contacts) {
  const Graph graph(2 + contacts / 2, contacts, draw);
  PacketOrder order = PacketScheduler(graph.inverse_mass).Order(graph.all, graph.a, graph.b);
  SubdomainProblem problem;
  problem.model = Row::kModel;
  problem.contact = order.contact;
  problem.packet_begin = order.begin;
  for (std::size_t i = 0; i < graph.inverse_mass.size(); ++i) {
    problem.body.push_back(static_cast<std::int32_t>(i));
    for (int k = 0; k < Inertias(Row::kModel); ++k) problem.inverse_mass.push_back(graph.inverse_mass[i] * (*draw)(0.1, 2));
    for (int d = 0; d < Dofs(Row::kModel); ++d) problem.free_velocity.push_back(draw->Below(4) == 0 ? 0.0 : (*draw)(-1, 1));
  }
  VisitRows(problem, [&](auto& rows) {
    for (const std::int32_t c : problem.contact) {
      if constexpr (std::is_same_v<std::decay_t<decltype(rows[0])>, Row>) {
        Row row = RandomRow(draw, Row{});
        row.a = graph.a[c];
        row.b = graph.b[c];
        rows.push_back(row);
      }
    }
  });
  return problem;
}

void ExpectSameBits(const std::vector<double>& x, const std::vector<double>& y) {
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    ASSERT_EQ(std::bit_cast<std::int64_t>(x[i]), std::bit_cast<std::int64_t>(y[i]))
        << "place " << i << ": " << x[i] << ", " << y[i];
  }
}

template <class Row>
void ExpectPacketsLikeThePlainLoop() {
  if (!PacketSweepHere<Row>()) GTEST_SKIP() << "this processor has no packets";
  Draw draw;
  for (int contacts : {1, 3, 4, 5, 8, 100, 2000}) {
    const SubdomainProblem problem = RandomProblem<Row>(&draw, contacts);
    SubdomainState plain{problem.free_velocity, std::vector<double>(Unknowns(Row::kModel) * contacts)}, packets = plain;
    bool moved = false;
    for (int sweep = 0; sweep < 20; ++sweep) {
      SweepWithStatistics(problem, &plain);  // always the plain loop
      VisitRows(problem, [&](const auto& rows) {
        if constexpr (std::is_same_v<std::decay_t<decltype(rows[0])>, Row>) {
          PacketSweepHere<Row>()(rows.data(), problem.packet_begin.data(), problem.packet_begin.size() - 1,
                                 problem.inverse_mass.data(), packets.velocity.data(), packets.impulse.data());
        }
      });
      ExpectSameBits(packets.velocity, plain.velocity);
      ExpectSameBits(packets.impulse, plain.impulse);
      moved = moved || plain.velocity != problem.free_velocity;
    }
    EXPECT_TRUE(moved || contacts < 8);
  }
}

TEST(PacketSweep, LeavesTheBitsOfThePlainLoopWithFriction) { ExpectPacketsLikeThePlainLoop<FrictionRow>(); }
TEST(PacketSweep, LeavesTheBitsOfThePlainLoopWithoutFriction) { ExpectPacketsLikeThePlainLoop<NormalRow>(); }

TEST(PacketSweep, ChangesNoSignOfZeroWhereNothingPushes) {
  if (!PacketSweepHere<FrictionRow>()) GTEST_SKIP() << "this processor has no packets";
  Draw draw;
  SubdomainProblem problem = RandomProblem<FrictionRow>(&draw, 50);
  for (FrictionRow& row : problem.friction) row.offset = 1.0;
  for (double& v : problem.free_velocity) v = draw.Below(2) == 0 ? 0.0 : -0.0;
  SubdomainState state{problem.free_velocity, std::vector<double>(100)};
  PacketSweepHere<FrictionRow>()(problem.friction.data(), problem.packet_begin.data(), problem.packet_begin.size() - 1,
                                 problem.inverse_mass.data(), state.velocity.data(), state.impulse.data());
  ExpectSameBits(state.velocity, problem.free_velocity);
}

}  // namespace
}  // namespace nscdd
