// SPDX-License-Identifier: Apache-2.0
#include "stepping/motion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "nscdd/step_problem.h"
#include "parallel/bytes.h"

namespace nscdd {
namespace {

/// A body whose motion the solve has changed is given this much more than it came.
constexpr double kMargin = 1.25;

}  // namespace

double Excursion(const BodyTable& bodies, std::size_t row, const Twist& v, double dt) {
  const double radius = bodies.bounding_radius[row];
  const bool turns_in_place = radius == bodies.radius[row] || std::isinf(radius);
  return dt * (Norm(Linear(v)) + (turns_in_place ? 0.0 : radius * std::abs(v.spin)));
}

std::vector<Twist> MotionOf(const BodyTable& bodies, const KnownMotion& known, const std::vector<Twist>& column, double dt) {
  std::vector<Twist> motion;
  motion.reserve(bodies.size());
  std::size_t k = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    while (k < known.id.size() && known.id[k] < bodies.id[i]) ++k;
    const bool is_known = k < known.id.size() && known.id[k] == bodies.id[i];
    motion.push_back(is_known ? column[k] : FreeMotion(bodies, i, dt));
  }
  return motion;
}

std::vector<double> ReachesOf(const BodyTable& bodies, const std::vector<Twist>& displacement, double alert, double period,
                              double dt) {
  std::vector<double> reaches;
  reaches.reserve(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Twist free = FreeVelocity(bodies, i, InverseMassOf(bodies, i), dt);
    double covered = std::max(Excursion(bodies, i, bodies.velocity[i], dt), Excursion(bodies, i, free, dt));
    const double moved = Excursion(bodies, i, displacement[i], dt);
    if (moved > std::max(covered, 0.5 * alert)) covered = kMargin * moved;
    if (period > 0.0) {
      const double width = bodies.kind[i] == BodyKind::kFree ? bodies.bounding_radius[i] : bodies.radius[i];
      covered = std::min(covered, 0.499 * period - width);
    }
    reaches.push_back(std::max(0.5 * alert, covered));
  }
  return reaches;
}

void ShareMotion(const Population& population, Communicator* communicator, std::vector<Twist>* motion) {
  const int me = communicator->rank();
  std::map<int, std::vector<std::byte>> parcels;
  for (std::size_t row = 0; row < population.size(); ++row) {
    if (population.owner[row] != me) continue;
    for (const int rank : population.holders[row]) {
      if (rank == me) continue;
      ByteWriter out(&parcels[rank]);
      out.Put(population.bodies.id[row]);
      out.Put((*motion)[row]);
    }
  }
  std::vector<Message> outgoing;
  for (auto& [rank, bytes] : parcels) outgoing.push_back({rank, std::move(bytes)});
  for (const Message& message : communicator->Deliver(std::move(outgoing))) {
    for (ByteReader in(message.bytes); !in.empty();) {
      const auto id = in.Get<std::int64_t>();
      (*motion)[population.RowOf(id)] = in.Get<Twist>();
    }
  }
}

}  // namespace nscdd
