// SPDX-License-Identifier: Apache-2.0
#include "check.h"

#include <algorithm>
#include <numeric>

#include "contact_columns.h"

namespace nscdd::conformance {
namespace {

template <typename T>
void Permute(const std::vector<std::size_t>& order, std::vector<T>* column) {
  std::vector<T> sorted;
  sorted.reserve(order.size());
  for (const std::size_t row : order) sorted.push_back((*column)[row]);
  column->swap(sorted);
}

void SortById(BodyTable* bodies) {
  std::vector<std::size_t> order(bodies->size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) { return bodies->id[p] < bodies->id[q]; });
  Permute(order, &bodies->id);
  Permute(order, &bodies->kind);
  Permute(order, &bodies->mass);
  Permute(order, &bodies->inertia);
  Permute(order, &bodies->radius);
  Permute(order, &bodies->bounding_radius);
  Permute(order, &bodies->pose);
  Permute(order, &bodies->velocity);
  Permute(order, &bodies->force);
}

void RequireColumns(const BodyTable& b) {
  const std::size_t n = b.size();
  Require(b.kind.size() == n && b.mass.size() == n && b.inertia.size() == n && b.radius.size() == n &&
              b.bounding_radius.size() == n && b.pose.size() == n && b.velocity.size() == n && b.force.size() == n,
          "ReadBodies gave {} ids, but columns of other lengths: Resize() the table", n);
}

void RequireColumns(const ContactTable& contacts, std::size_t rows) {
  const std::size_t n = contacts.size();
  Require(contacts.a.size() == n && contacts.b.size() == n && contacts.shape_a.size() == n && contacts.shape_b.size() == n &&
              contacts.normal.size() == n && contacts.lever_a.size() == n && contacts.lever_b.size() == n &&
              contacts.site.size() == n && contacts.flat.size() == n && contacts.friction.size() == n &&
              contacts.restitution.size() == n,
          "DetectContacts gave {} gaps, but columns of other lengths", n);
  Require(contacts.image.empty() || contacts.image.size() == n, "DetectContacts gave {} contacts and {} images", n,
          contacts.image.size());
  Require((contacts.arm_a.empty() && contacts.arm_b.empty()) || (contacts.arm_a.size() == n && contacts.arm_b.size() == n),
          "DetectContacts gave {} contacts, {} and {} arms: all or none", n, contacts.arm_a.size(), contacts.arm_b.size());
  for (std::size_t i = 0; i < n; ++i) {
    const bool inside = contacts.a[i] >= 0 && contacts.a[i] < contacts.b[i] && static_cast<std::size_t>(contacts.b[i]) < rows;
    Require(inside, "contact {} joins rows {} and {} of {}: A < B, both rows of the given poses", i, contacts.a[i],
            contacts.b[i], rows);
  }
}

}  // namespace

Session::Session(std::unique_ptr<Host> host, const Fault* fault) : host_(std::move(host)), adapter_(host_->adapter()) {
  if (fault != nullptr) {
    broken_ = std::make_unique<BrokenAdapter>(adapter_, *fault);
    adapter_ = broken_.get();
  }
}

BodyTable Session::Read() {
  BodyTable bodies;
  bodies.Resize(3);  // must be overwritten
  adapter_->ReadBodies(&bodies);
  RequireColumns(bodies);
  SortById(&bodies);
  return bodies;
}

ContactTable Session::Detect(const BodyTable& bodies, double alert) {
  ContactTable contacts;
  adapter_->DetectContacts({bodies.id, bodies.pose}, alert, &contacts);
  RequireColumns(contacts, bodies.size());
  return contacts;
}

void Session::Commit(const BodyTable& bodies) { adapter_->Commit({bodies.id, bodies.pose, bodies.velocity, {}, {}}); }

Session Trial::NewSession(double period) {
  std::unique_ptr<Host> host = factory_(period);
  if (host == nullptr) throw CheckSkipped(fmt::format("the platform has no worlds of period {}", period));
  return {std::move(host), fault_};
}

std::size_t RowOf(const BodyTable& bodies, std::int64_t id) {
  const auto position = std::lower_bound(bodies.id.begin(), bodies.id.end(), id);
  Require(position != bodies.id.end() && *position == id,
          "ReadBodies does not name body {}, which the host added under this id", id);
  return static_cast<std::size_t>(position - bodies.id.begin());
}

std::vector<Check> AllChecks() {
  std::vector<Check> all;
  for (auto part :
       {BodyChecks, PairChecks, GeometryChecks, SweepChecks, HostChecks, RefusalChecks, DistributionChecks, ClosedFormChecks}) {
    for (Check& check : part()) all.push_back(std::move(check));
  }
  return all;
}

}  // namespace nscdd::conformance
