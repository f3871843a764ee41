// SPDX-License-Identifier: Apache-2.0
// Bad calls are refused with a sentence, and change nothing.
#include <limits>
#include <string>
#include <vector>

#include "check.h"
#include "nscdd/error.h"
#include "scenes.h"

namespace nscdd::conformance {
namespace {

/// The call must throw nscdd::Error with a sentence, one that names `id` unless that is negative.
template <typename Call>
void RequireRefusal(const char* what, std::int64_t id, Call call) {
  try {
    call();
  } catch (const Error& error) {
    const std::string sentence = error.what();
    Require(sentence.size() >= 20 && sentence.find(' ') != std::string::npos, "{} is refused with \"{}\", which is no sentence",
            what, sentence);
    Require(id < 0 || sentence.find(std::to_string(id)) != std::string::npos,
            "{} is refused with \"{}\", which does not name body {}", what, sentence, id);
    return;
  } catch (const CheckFailed&) {
    throw;
  } catch (const std::exception& other) {
    Require(false, "{} throws something else than nscdd::Error: {}", what, other.what());
  }
  Require(false, "{} is not refused", what);
}

void RefuseDetections(Session* session, const BodyTable& bodies) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t last = bodies.size() - 1;
  ContactTable contacts;
  const auto detect = [&](const BodyTable& at, double alert) {
    session->adapter().DetectContacts({at.id, at.pose}, alert, &contacts);
  };
  BodyTable bad = bodies;
  bad.id[last] += 1000;
  RequireRefusal("a pose of a body that is not there", -1, [&] { detect(bad, 0.1); });
  bad = bodies;
  bad.Resize(last);
  RequireRefusal("a missing pose", -1, [&] { detect(bad, 0.1); });
  bad = bodies;
  std::swap(bad.id[0], bad.id[1]);
  RequireRefusal("poses in descending order", -1, [&] { detect(bad, 0.1); });
  bad = bodies;
  bad.pose[1].y = nan;
  RequireRefusal("a pose that is not a number", bodies.id[1], [&] { detect(bad, 0.1); });
  RequireRefusal("a negative alert distance", -1, [&] { detect(bodies, -0.1); });
  RequireRefusal("an alert distance that is not a number", -1, [&] { detect(bodies, nan); });
}

void RefuseCommits(Session* session, const BodyTable& bodies) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BodyTable bad = bodies;
  bad.id.back() = 987654321;
  RequireRefusal("Commit of a body that is not there", 987654321, [&] { session->Commit(bad); });
  bad = bodies;
  bad.pose.back().x = nan;
  RequireRefusal("Commit of a pose that is not a number", bodies.id.back(), [&] { session->Commit(bad); });
  bad = bodies;
  bad.velocity.back().spin = std::numeric_limits<double>::infinity();
  RequireRefusal("Commit of an infinite spin", bodies.id.back(), [&] { session->Commit(bad); });
  RequireRefusal("Commit of columns of different lengths", -1, [&] {
    session->adapter().Commit({bodies.id, bodies.pose, {}, {}, {}});
  });
}

void RefuseTransports(Session* session, const BodyTable& bodies) {
  BodyTransport* transport = session->adapter().transport();
  if (transport == nullptr) return;
  std::vector<std::byte> bytes;
  RequireRefusal("Pack of a body that is not there", 987654321, [&] { transport->Pack(987654321, &bytes); });
  RequireRefusal("Remove of a body that is not there", 987654321, [&] { transport->Remove(987654321); });
  bytes.clear();
  transport->Pack(bodies.id[0], &bytes);
  RequireRefusal("Insert of a body that is there already", bodies.id[0], [&] { transport->Insert(bodies.id[0], bytes); });
  RequireRefusal("Insert of half a body", -1, [&] { transport->Insert(987654321, std::span(bytes).first(bytes.size() / 2)); });
  RequireRefusal("Insert from no bytes", -1, [&] { transport->Insert(987654321, {}); });
}

void RefusalsSpeak(Trial* trial) {
  Session session = trial->NewSession();
  AddRandomDisks(6, {0.0, 0.0}, 6.0, &session, &trial->random);
  const BodyTable before = session.Read();
  BodyTable moved = before;
  for (Pose& pose : moved.pose) pose.x += 1.0;
  RefuseDetections(&session, moved);
  RefuseCommits(&session, moved);
  RefuseTransports(&session, moved);
  RequireUnchanged(before, session.Read(), "a refused call");
}

Fault SwallowsErrors() {
  Fault fault;
  fault.name = "errors swallowed";
  fault.detect = [](PlatformAdapter* whole, const PoseView& poses, double alert, ContactTable* contacts) {
    try {
      whole->DetectContacts(poses, alert, contacts);
    } catch (const Error&) {
      contacts->Clear();
    }
  };
  return fault;
}

Fault Mumbles() {
  Fault fault;
  fault.name = "errors without a sentence";
  fault.commit = [](PlatformAdapter* whole, const StepResult& result) {
    try {
      whole->Commit(result);
    } catch (const Error&) {
      throw Error("bad argument");
    }
  };
  return fault;
}

}  // namespace

std::vector<Check> RefusalChecks() {
  return {
      {"refusals_speak",
       "bad calls are refused with a sentence and change nothing",
       RefusalsSpeak,
       {SwallowsErrors(), Mumbles()}},
  };
}

}  // namespace nscdd::conformance
