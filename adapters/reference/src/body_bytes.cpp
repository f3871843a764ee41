// SPDX-License-Identifier: Apache-2.0
#include "body_bytes.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "nscdd/error.h"

namespace nscdd::reference {
namespace {

/// Everything of a body but its shapes; begins the bytes.
struct Header {
  std::uint64_t magic;
  std::int64_t id;
  std::array<double, 13> numbers;  // mass, inertia, pose, velocity, force, friction, restitution
  std::array<std::uint32_t, 3> counts;
  Filter filter;
  std::uint32_t kind;
  std::uint32_t unused;
};
constexpr std::uint64_t kMagic = 0x3164'6f62'6664'736eULL;

template <typename T>
void Append(const T* first, std::size_t count, std::vector<std::byte>* bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t begin = bytes->size();
  bytes->resize(begin + count * sizeof(T));
  if (count != 0) std::memcpy(bytes->data() + begin, first, count * sizeof(T));
}

template <typename T>
void Take(std::span<const std::byte>* bytes, std::size_t count, std::vector<T>* values) {
  values->resize(count);
  if (count != 0) std::memcpy(values->data(), bytes->data(), count * sizeof(T));
  *bytes = bytes->subspan(count * sizeof(T));
}

}  // namespace

void AppendBytes(const Body& body, std::vector<std::byte>* bytes) {
  const Pose& q = body.pose;
  const Twist& v = body.velocity;
  const Wrench& f = body.force;
  const auto count = [](const auto& shapes) { return static_cast<std::uint32_t>(shapes.size()); };
  const Header header{
      kMagic,
      body.id,
      {body.mass, body.inertia, q.x, q.y, q.angle, v.vx, v.vy, v.spin, f.fx, f.fy, f.torque, body.friction, body.restitution},
      {count(body.disks), count(body.segments), count(body.half_planes)},
      body.filter,
      static_cast<std::uint32_t>(body.kind),
      0};
  Append(&header, 1, bytes);
  Append(body.disks.data(), body.disks.size(), bytes);
  Append(body.segments.data(), body.segments.size(), bytes);
  Append(body.half_planes.data(), body.half_planes.size(), bytes);
}

Body BodyFromBytes(std::span<const std::byte> bytes) {
  Header header{};
  const std::size_t given = bytes.size();
  if (given >= sizeof(Header)) std::memcpy(&header, bytes.data(), sizeof(Header));
  const auto [disks, segments, half_planes] = header.counts;
  const std::size_t expected =
      sizeof(Header) + disks * sizeof(Disk) + segments * sizeof(Segment) + half_planes * sizeof(HalfPlane);
  if (header.magic != kMagic || given != expected) {
    throw Error(
        fmt::format("{} bytes are not a body of the reference world: pass those that Pack() wrote, all of them.", given));
  }
  const auto& n = header.numbers;
  Body body;
  body.id = header.id;
  body.kind = static_cast<BodyKind>(header.kind);
  body.mass = n[0];
  body.inertia = n[1];
  body.pose = {n[2], n[3], n[4]};
  body.velocity = {n[5], n[6], n[7]};
  body.force = {n[8], n[9], n[10]};
  body.friction = n[11];
  body.restitution = n[12];
  body.filter = header.filter;
  bytes = bytes.subspan(sizeof(Header));
  Take(&bytes, disks, &body.disks);
  Take(&bytes, segments, &body.segments);
  Take(&bytes, half_planes, &body.half_planes);
  return body;
}

}  // namespace nscdd::reference
