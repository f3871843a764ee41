// SPDX-License-Identifier: Apache-2.0
#include "contact_detector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "nscdd/error.h"

namespace nscdd::reference {
namespace {

std::size_t Index(std::int32_t i) { return static_cast<std::size_t>(i); }

void CheckAlert(double alert) {
  if (alert >= 0.0 && std::isfinite(alert)) return;
  throw Error(fmt::format("DetectContacts got the alert distance {}: give a finite length >= 0 in metres.", alert));
}

void CheckMotion(const MotionView& motion) {
  if (motion.velocity.size() != motion.id.size() || motion.reach.size() != motion.id.size()) {
    throw Error(fmt::format("SweepContacts got {} ids, {} velocities and {} reaches: give one of each for each body.",
                            motion.id.size(), motion.velocity.size(), motion.reach.size()));
  }
  for (std::size_t i = 0; i < motion.id.size(); ++i) {
    const Twist& v = motion.velocity[i];
    if (motion.reach[i] >= 0.0 && std::isfinite(motion.dt * (v.vx + v.vy + v.spin) + motion.reach[i])) continue;
    throw Error(fmt::format("SweepContacts got body {} at ({}, {}, {}) for {} s and a reach of {} m: numbers must be finite.",
                            motion.id[i], v.vx, v.vy, v.spin, motion.dt, motion.reach[i]));
  }
}

void CheckLengths(const PoseView& poses) {
  if (poses.id.size() != poses.pose.size()) {
    throw Error(
        fmt::format("DetectContacts got {} ids and {} poses: give one pose for each id.", poses.id.size(), poses.pose.size()));
  }
}

[[noreturn]] void RefuseUnknown(std::int64_t id) {
  throw Error(
      fmt::format("DetectContacts got a pose of body {}, which the reference world does not hold there: name each of its "
                  "bodies once, in ascending order.",
                  id));
}

/// Row `row` of the poses must be of body `id`.
void CheckRow(const PoseView& poses, std::size_t row, std::int64_t id) {
  if (row == poses.id.size() || poses.id[row] > id) {
    throw Error(
        fmt::format("DetectContacts got no pose of body {} in its place: name every body of the reference world once, in "
                    "ascending order.",
                    id));
  }
  if (poses.id[row] < id) RefuseUnknown(poses.id[row]);
  const Pose& q = poses.pose[row];
  if (!std::isfinite(q.x + q.y + q.angle)) {
    throw Error(fmt::format("DetectContacts got body {} at ({}, {}, {}): poses must be finite.", id, q.x, q.y, q.angle));
  }
}

}  // namespace

void ContactDetector::Detect(const World& world, const PoseView& poses, double alert, ContactTable* contacts) {
  CheckAlert(alert);
  alert_ = 0.5 * alert;
  motion_ = nullptr;
  Find(world, poses, contacts);
}

void ContactDetector::Sweep(const World& world, const MotionView& motion, ContactTable* contacts) {
  CheckMotion(motion);
  motion_ = &motion;
  Find(world, {motion.id, motion.pose}, contacts);
}

void ContactDetector::Find(const World& world, const PoseView& poses, ContactTable* contacts) {
  CheckLengths(poses);
  period_ = world.period;
  period_origin_ = world.period_origin;
  PlaceShapes(world, poses);
  if (period_ > 0.0) CheckPeriod(world);
  FillClasses();
  candidates_.clear();
  meetings_.clear();
  FindDiskPairs();
  FindWallPairs();
  SortCandidates();
  FillTable(contacts);
}

void ContactDetector::PlaceShapes(const World& world, const PoseView& poses) {
  rows_.clear();
  disks_.clear();
  walls_.clear();
  double farthest = period_ + std::abs(period_origin_);
  largest_ = 0.0;
  for (const Body& body : world.bodies()) {
    const auto row = static_cast<std::int32_t>(rows_.size());
    CheckRow(poses, rows_.size(), body.id);
    const Pose& q = poses.pose[rows_.size()];
    const bool centred = body.disks.size() == 1 && body.disks[0].centre.x == 0.0 && body.disks[0].centre.y == 0.0;
    const double c = centred ? 1.0 : std::cos(q.angle), s = centred ? 0.0 : std::sin(q.angle);
    rows_.push_back(RowOf(body, rows_.size()));
    std::int32_t shape = 0;
    for (const Disk& disk : body.disks) {
      const Vec2 arm = centred ? Vec2{} : Vec2{c * disk.centre.x - s * disk.centre.y, s * disk.centre.x + c * disk.centre.y};
      disks_.push_back({Centre(q) + arm, arm, disk.radius, row, shape++});
      largest_ = std::max(largest_, disk.radius + rows_.back().reach);
    }
    farthest = std::max({farthest, std::abs(q.x), std::abs(q.y)});
    if (!body.segments.empty() || !body.half_planes.empty()) PlaceWalls(body, q, row);
  }
  if (rows_.size() != poses.id.size()) RefuseUnknown(poses.id[rows_.size()]);
  slack_ = 1e-14 * farthest;
}

ContactDetector::Row ContactDetector::RowOf(const Body& body, std::size_t row) const {
  Row r{body.filter, body.kind == BodyKind::kFree, body.friction, body.restitution, alert_, {}, 0.0};
  if (motion_ == nullptr) return r;
  r.reach = motion_->reach[row];
  r.move = motion_->dt * Linear(motion_->velocity[row]);
  r.turn = motion_->dt * motion_->velocity[row].spin;
  return r;
}

void ContactDetector::CheckPeriod(const World& world) const {
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const Body& body = world.bodies()[row];
    double width = 0.0;
    for (const Disk& disk : body.disks) width = std::max(width, 2.0 * (Norm(disk.centre) + disk.radius));
    const double alert = 2.0 * rows_[row].reach;
    if (body.kind == BodyKind::kFree && !(width + alert < period_)) {
      throw Error(
          fmt::format("Body {} of the reference world is {} m wide and would touch its own image: make the period {} longer "
                      "than that and the alert distance {}.",
                      body.id, width, period_, alert));
    }
  }
  if (!(2.0 * largest_ < period_)) {
    throw Error(fmt::format("The reference world's period {} is too short for disks of radius {} with the alert distance.",
                            period_, largest_));
  }
  for (const PlacedWall& wall : walls_) {
    const std::int64_t id = world.bodies()[Index(wall.row)].id;
    if (wall.is_segment && std::abs(wall.b.x - wall.a.x) > period_ * (1.0 + 1e-12)) {
      throw Error(fmt::format("Segment {} of body {} is {} m long in x, more than the period {}: cut it to one period.",
                              wall.shape, id, std::abs(wall.b.x - wall.a.x), period_));
    }
    if (!wall.is_segment && std::abs(wall.normal.x) > 1e-12) {
      throw Error(
          fmt::format("Half-plane {} of body {} is not horizontal, yet the world is periodic in x: turn it.", wall.shape, id));
    }
  }
}

void ContactDetector::AddEntry(SizeClass* size_class, std::int32_t disk, double radius) const {
  const PlacedDisk& d = disks_[Index(disk)];
  GridEntry entry{d.centre.x, d.centre.y, radius, disk, 0, false};
  size_class->max_radius = std::max(size_class->max_radius, radius);
  if (period_ > 0.0) {
    const double periods = std::floor((d.centre.x - period_origin_) / period_);
    if (std::abs(periods) > 1e9) throw Error(fmt::format("A body is {} periods away: bring it back into the period.", periods));
    entry.shift = static_cast<std::int32_t>(-periods);
    entry.x = d.centre.x - periods * period_;
    size_class->entries.push_back(entry);
    if (entry.x - period_origin_ > radius + largest_ + slack_) return;
    entry.x = d.centre.x - (periods - 1.0) * period_;
    ++entry.shift;
    entry.is_copy = true;
  }
  size_class->entries.push_back(entry);
}

void ContactDetector::FillClasses() {
  for (auto& [key, old] : classes_) {
    old.max_radius = 0.0;
    old.entries.clear();
  }
  int size = -1;
  SizeClass* size_class = nullptr;
  for (std::size_t i = 0; i < disks_.size(); ++i) {
    const double radius = disks_[i].radius + rows_[Index(disks_[i].row)].reach;
    const int own_size = std::ilogb(largest_ / radius);
    if (own_size != size) size_class = &classes_[size = own_size];
    AddEntry(size_class, static_cast<std::int32_t>(i), radius);
  }
  std::erase_if(classes_, [](const auto& item) { return item.second.entries.empty(); });
  for (auto& [key, used] : classes_) {
    used.grid.Build(&used.entries, 2.0 * used.max_radius + slack_);
  }
}

double ContactDetector::ReachOf(std::int32_t row, std::int32_t other) const {
  return rows_[Index(row)].reach + rows_[Index(other)].reach;
}

bool ContactDetector::Touchable(std::int32_t row, std::int32_t other) const {
  const Row &one = rows_[Index(row)], &two = rows_[Index(other)];
  return row != other && (one.is_free || two.is_free) && MayTouch(one.filter, two.filter);
}

void ContactDetector::AddDiskPair(const GridEntry& one, const GridEntry& other) {
  const Vec2 d{other.x - one.x, other.y - one.y};
  const double reach = one.radius + other.radius + slack_;
  if (Dot(d, d) > reach * reach * (1.0 + 1e-12) || (one.is_copy && other.is_copy)) return;
  const bool swapped = disks_[Index(other.disk)].row < disks_[Index(one.disk)].row;
  const GridEntry &entry_a = swapped ? other : one, &entry_b = swapped ? one : other;
  const PlacedDisk &a = disks_[Index(entry_a.disk)], &b = disks_[Index(entry_b.disk)];
  if (!Touchable(a.row, b.row)) return;
  const std::int32_t image = entry_b.shift - entry_a.shift;
  const Vec2 exact{b.centre.x + image * period_ - a.centre.x, b.centre.y - a.centre.y};
  if (std::sqrt(Dot(exact, exact)) - (a.radius + b.radius) > ReachOf(a.row, b.row)) return;
  candidates_.push_back({a.row, b.row, a.shape, b.shape, image, entry_a.disk, entry_b.disk});
}

void ContactDetector::FindDiskPairs() {
  const auto add = [&](const GridEntry& one, const GridEntry& other) { AddDiskPair(one, other); };
  for (auto large = classes_.begin(); large != classes_.end(); ++large) {
    large->second.grid.VisitPairs(add);
    for (auto small = std::next(large); small != classes_.end(); ++small) {
      for (const GridEntry& entry : small->second.entries) {
        large->second.grid.VisitAround(entry.x, entry.y, [&](const GridEntry& other) { add(entry, other); });
      }
    }
  }
}

void ContactDetector::SortCandidates() {
  // Stable counting sort by A, then the few contacts of each A by the rest of their keys.
  first_.assign(rows_.size() + 1, 0);
  for (const Candidate& candidate : candidates_) ++first_[Index(candidate.a)];
  std::size_t sum = 0;
  for (std::size_t& first : first_) sum += std::exchange(first, sum);
  sorted_.resize(candidates_.size());
  for (const Candidate& candidate : candidates_) sorted_[first_[Index(candidate.a)]++] = candidate;
  auto begin = sorted_.begin();
  for (std::size_t row = 0; row < rows_.size(); ++row) {  // first_[row] is now where its contacts end
    const auto end = sorted_.begin() + static_cast<std::ptrdiff_t>(first_[row]);
    std::sort(begin, end, [](const Candidate& p, const Candidate& q) {
      return std::tie(p.b, p.shape_a, p.shape_b, p.image) < std::tie(q.b, q.shape_a, q.shape_b, q.image);
    });
    begin = end;
  }
  candidates_.swap(sorted_);
}

}  // namespace nscdd::reference
