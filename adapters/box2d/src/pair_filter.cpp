// SPDX-License-Identifier: Apache-2.0
#include "pair_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <typeinfo>

#include "nscdd/error.h"

namespace nscdd::box2d {
namespace {

bool Moves(const b2Body* body) { return body->GetType() == b2_dynamicBody; }

}  // namespace

void PairFilter::Read(b2World* world, const BodyStore& store, bool joints_only_filter) {
  b2ContactFilter* filter = world->GetContactManager().m_contactFilter;
  users_ = filter == nullptr || typeid(*filter) == typeid(b2ContactFilter) ? nullptr : filter;
  jointed_.clear();
  for (b2Joint* joint = world->GetJointList(); joint != nullptr; joint = joint->GetNext()) {
    const std::int32_t a = store.SlotOf(joint->GetBodyA()), b = store.SlotOf(joint->GetBodyB());
    if (!joints_only_filter && joint->IsEnabled() && (Moves(joint->GetBodyA()) || Moves(joint->GetBodyB()))) {
      throw Error(
          fmt::format("A Box2D joint connects bodies {} and {}; joints are not solved: destroy it, or set "
                      "Box2dOptions::joints_only_filter to keep it as a mere collision filter.",
                      store.record(a).id, store.record(b).id));
    }
    if (!joint->GetCollideConnected()) jointed_.emplace_back(std::min(a, b), std::max(a, b));
  }
  std::sort(jointed_.begin(), jointed_.end());
}

bool PairFilter::AsksUser(const Shape& a, const Shape& b) const {
  const std::pair bodies{std::min(a.body, b.body), std::max(a.body, b.body)};
  if (std::binary_search(jointed_.begin(), jointed_.end(), bodies)) return false;
  return users_ != nullptr ? users_->ShouldCollide(a.fixture, b.fixture) : AllowsByBits(a, b);
}

}  // namespace nscdd::box2d
