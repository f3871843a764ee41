// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "nscdd/communicator.h"
#include "nscdd/error.h"
#include "nscdd/reference/reference_adapter.h"
#include "nscdd/time_stepper.h"
#include "packing.h"
#include "rows.h"

namespace nscdd::test {

/// The reference adapter, which fails once when it is told to.
class FaultyAdapter final : public PlatformAdapter {
 public:
  enum class Fault { kNone, kRead, kPack, kInsert, kRemove, kDetect, kCommit };

  explicit FaultyAdapter(reference::World* world) : inner_(world), transport_(this) {}
  /// After `calls` more calls that succeed.
  void FailOnceIn(Fault fault, int calls = 0) {
    fault_ = fault;
    calls_ = calls;
  }

  AdapterDescription Describe() const override { return inner_.Describe(); }
  void ReadBodies(BodyTable* bodies) override {
    FailIn(Fault::kRead);
    inner_.ReadBodies(bodies);
  }
  void DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) override {
    FailIn(Fault::kDetect);
    inner_.DetectContacts(poses, alert, contacts);
  }
  void SweepContacts(const MotionView& motion, ContactTable* contacts) override {
    FailIn(Fault::kDetect);
    inner_.SweepContacts(motion, contacts);
  }
  void Commit(const StepResult& result) override {
    FailIn(Fault::kCommit);
    inner_.Commit(result);
  }
  BodyTransport* transport() override { return &transport_; }

 private:
  class Transport final : public BodyTransport {
   public:
    explicit Transport(FaultyAdapter* owner) : owner_(owner) {}
    void Pack(std::int64_t id, std::vector<std::byte>* bytes) override {
      owner_->FailIn(Fault::kPack);
      owner_->inner_.transport()->Pack(id, bytes);
    }
    void Insert(std::int64_t id, std::span<const std::byte> bytes) override {
      owner_->FailIn(Fault::kInsert);
      owner_->inner_.transport()->Insert(id, bytes);
    }
    void Remove(std::int64_t id) override {
      owner_->FailIn(Fault::kRemove);
      owner_->inner_.transport()->Remove(id);
    }

   private:
    FaultyAdapter* owner_;
  };

  void FailIn(Fault fault) {
    if (fault_ != fault || calls_-- > 0) return;
    fault_ = Fault::kNone;
    throw std::runtime_error("the platform lost its mind");
  }

  reference::ReferenceAdapter inner_;
  Transport transport_;
  Fault fault_ = Fault::kNone;
  int calls_ = 0;
};

/// One rank of a run: its part of a packing. Body number k begins on rank k % ranks, so nearly all of them move at first.
struct RankedHost {
  RankedHost(const Packing& packing, const NscddOptions& options, Communicator* world_communicator)
      : communicator(world_communicator) {
    world.gravity = {2.0, -9.0};
    const std::vector<reference::Body> all = MakeBodies(packing);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (static_cast<int>(k) % communicator->size() == communicator->rank()) world.Add(all[k]);
    }
    Start(options);
  }

  void Start(const NscddOptions& options) {
    stepper.reset();
    adapter = std::make_unique<FaultyAdapter>(&world);
    stepper = std::make_unique<TimeStepper>(SteppingOptions{}, options, adapter.get(), communicator);
  }

  /// True on the rank that moves the body.
  bool Owns(std::int64_t id) const { return std::ranges::count(stepper->bodies().id, id) > 0; }
  void Step(int count) {
    for (int k = 0; k < count; ++k) stepper->Step(0.01);
  }

  Communicator* communicator;
  reference::World world;
  std::unique_ptr<FaultyAdapter> adapter;
  std::unique_ptr<TimeStepper> stepper;
};

/// Bodies of all ranks by id: id, pose, velocity, multiplicity, subdomain.
inline std::vector<std::vector<double>> Gather(const RankedHost& host) {
  std::vector<double> mine;
  for (const test::BodyRow& b : test::Rows(host.stepper->bodies())) {
    mine.insert(mine.end(), {static_cast<double>(b.id), b.pose.x, b.pose.y, b.pose.angle, b.velocity.vx, b.velocity.vy,
                             b.velocity.spin, static_cast<double>(b.multiplicity), static_cast<double>(b.subdomain)});
  }
  const std::vector<double> all = host.communicator->AllGather(mine);
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < all.size(); i += 9) rows.emplace_back(all.begin() + i, all.begin() + i + 9);
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// What an Error on this rank says; empty if there is none.
inline std::string RefusalOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

}  // namespace nscdd::test
