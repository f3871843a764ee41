// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <box2d/box2d.h>

#include <cmath>
#include <string>
#include <vector>

#include "nscdd/box2d/box2d_adapter.h"
#include "nscdd/error.h"

namespace nscdd::box2d {

inline b2Body* AddBody(b2World* world, b2BodyType type, b2Vec2 position, float angle = 0.0f) {
  b2BodyDef def;
  def.type = type;
  def.position = position;
  def.angle = angle;
  return world->CreateBody(&def);
}

inline b2Fixture* AddCircle(b2Body* body, float radius, b2Vec2 centre = {0.0f, 0.0f}, float density = 1.0f) {
  b2CircleShape circle;
  circle.m_radius = radius;
  circle.m_p = centre;
  return body->CreateFixture(&circle, density);
}

inline b2Body* AddDisk(b2World* world, b2Vec2 position, float radius = 1.0f) {
  b2Body* body = AddBody(world, b2_dynamicBody, position);
  AddCircle(body, radius);
  return body;
}

inline b2Fixture* AddEdge(b2Body* body, b2Vec2 begin, b2Vec2 end) {
  b2EdgeShape edge;
  edge.SetTwoSided(begin, end);
  return body->CreateFixture(&edge, 0.0f);
}

/// Contacts at the poses that ReadBodies returns.
inline ContactTable Detect(Box2dAdapter* adapter, double alert, BodyTable* bodies) {
  ContactTable contacts;
  adapter->ReadBodies(bodies);
  adapter->DetectContacts({bodies->id, bodies->pose}, alert, &contacts);
  return contacts;
}

inline ContactTable Detect(Box2dAdapter* adapter, double alert) {
  BodyTable bodies;
  return Detect(adapter, alert, &bodies);
}

/// The sentence of the Error that `call` throws; empty if it throws none.
template <typename Call>
std::string Refusal(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

inline bool Contains(const std::string& sentence, const std::string& part) { return sentence.find(part) != std::string::npos; }

}  // namespace nscdd::box2d
