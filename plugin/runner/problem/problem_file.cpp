#include "problem/problem_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nscdd/error.h"

namespace nscdd {
namespace {

using Json = nlohmann::json;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The file as JSON, with sentences for what is missing.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : name_(path.string()) {
    std::ifstream in(path);
    if (!in) throw Error(fmt::format("{}: the file cannot be opened; check the path", name_));
    try {
      json_ = Json::parse(in);
    } catch (const Json::exception& e) {
      throw Error(fmt::format("{}: not valid JSON: {}", name_, e.what()));
    }
    if (!json_.is_object()) Refuse("the file", "is not an object; write {\"dt\": ..., \"bodies\": [...], ...}");
  }

  [[noreturn]] void Refuse(const std::string& where, const std::string& what) const {
    throw Error(fmt::format("{}: {} {}", name_, where, what));
  }

  double Number(const char* key) const {
    const auto at = json_.find(key);
    if (at == json_.end()) Refuse(fmt::format("key '{}'", key), "is missing");
    return ToNumber(*at, fmt::format("key '{}'", key));
  }

  double Number(const char* key, double otherwise) const { return json_.contains(key) ? Number(key) : otherwise; }

  /// A list of numbers; `at_least` of them.
  std::vector<double> Row(const Json& row, const std::string& where, std::size_t at_least) const {
    if (!row.is_array() || row.size() < at_least) Refuse(where, fmt::format("needs {} numbers", at_least));
    std::vector<double> numbers;
    for (std::size_t k = 0; k < at_least; ++k) numbers.push_back(ToNumber(row[k], where));
    return numbers;
  }

  /// The rows of a table; none if the key is missing and `optional`.
  std::vector<std::vector<double>> Table(const char* key, std::size_t columns, bool optional) const {
    const auto at = json_.find(key);
    if (at == json_.end()) {
      if (!optional) Refuse(fmt::format("key '{}'", key), "is missing");
      return {};
    }
    if (!at->is_array()) Refuse(fmt::format("key '{}'", key), "is not a list of rows");
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 0; i < at->size(); ++i) rows.push_back(Row((*at)[i], fmt::format("'{}' row {}", key, i), columns));
    return rows;
  }

  const Json& json() const { return json_; }

 private:
  double ToNumber(const Json& value, const std::string& where) const {
    if (!value.is_number()) Refuse(where, fmt::format("holds {} where a number is needed", value.dump()));
    const double number = value.get<double>();
    if (!std::isfinite(number)) Refuse(where, "holds a number that is not finite");
    return number;
  }

  std::string name_;
  Json json_;
};

struct Start {
  std::vector<Pose> pose;      // at the detection configuration
  std::vector<Twist> velocity;  // at the beginning
};

void AddBodies(const Reader& file, double dt, double theta, ContactProblem* problem, Start* start) {
  const auto gravity = file.Row(file.json().value("gravity", Json::array({0.0, 0.0})), "key 'gravity'", 2);
  const auto bodies = file.Table("bodies", 10, false);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto& b = bodies[i];
    const bool fixed = b[9] != 0.0;
    if (!fixed && (!(b[7] > 0.0) || !(b[8] > 0.0))) {
      file.Refuse(fmt::format("'bodies' row {}", i), "has a mass or inertia that is not positive");
    }
    const Twist v{b[3], b[4], b[5]};
    const double drift = (1.0 - theta) * dt;
    problem->mass.push_back(fixed ? kInfinity : b[7]);
    problem->inertia.push_back(fixed ? kInfinity : b[8]);
    problem->free_velocity.push_back(fixed ? v : Twist{v.vx + dt * gravity[0], v.vy + dt * gravity[1], v.spin});
    problem->impulse.push_back(fixed ? Wrench{} : Wrench{dt * b[7] * gravity[0], dt * b[7] * gravity[1], 0.0});
    start->pose.push_back({b[0] + drift * v.vx, b[1] + drift * v.vy, b[2] + drift * v.spin});
    start->velocity.push_back(v);
  }
  for ([[maybe_unused]] const auto& plane : file.Table("planes", 3, true)) {
    problem->mass.push_back(kInfinity);
    problem->inertia.push_back(kInfinity);
    problem->free_velocity.push_back({});
    problem->impulse.push_back({});
    start->pose.push_back({});
    start->velocity.push_back({});
  }
}

std::int32_t BodyRow(const Reader& file, double number, std::size_t contact, std::size_t bodies, std::size_t all) {
  const double row = number < 0.0 ? static_cast<double>(bodies) - 1.0 - number : number;
  if (row != std::floor(row) || !(row < static_cast<double>(all)) || (number >= 0.0 && row >= static_cast<double>(bodies))) {
    file.Refuse(fmt::format("'contacts' row {}", contact),
                fmt::format("names body or plane {}; there are {} bodies and {} planes", number, bodies, all - bodies));
  }
  return static_cast<std::int32_t>(row);
}

void AddContacts(const Reader& file, std::size_t bodies, double mu, const Start& start, ContactProblem* problem) {
  ContactTable& t = problem->contacts;
  const auto contacts = file.Table("contacts", 8, false);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto& row = contacts[c];
    const std::int32_t b = BodyRow(file, row[0], c, bodies, problem->mass.size());
    const std::int32_t a = BodyRow(file, row[1], c, bodies, problem->mass.size());
    const Vec2 n{row[2], row[3]};
    t.a.push_back(a);
    t.b.push_back(b);
    t.normal.push_back(n);
    t.gap.push_back(row[4]);
    t.lever_b.push_back(row[5]);
    t.lever_a.push_back(row[6]);
    t.friction.push_back(mu);
    t.restitution.push_back(0.0);  // is in b_n already
    t.flat.push_back(0);
    const Vec2 centre = Centre(start.pose[b]);
    const bool plane = a >= static_cast<std::int32_t>(bodies);
    t.site.push_back(plane ? centre - row[5] * n : 0.5 * (centre + Centre(start.pose[a])));
    problem->offset.push_back(row[7]);
    const double approach = Dot(n, Linear(start.velocity[b]) - Linear(start.velocity[a]));
    problem->approach_speed = std::max(problem->approach_speed, -approach);
  }
}

}  // namespace

ProblemFile ReadProblemFile(const std::filesystem::path& path) {
  const Reader file(path);
  ProblemFile result;
  const double dt = file.Number("dt"), mu = file.Number("mu", 0.0);
  result.theta = file.Number("theta", 0.5);
  if (!(dt > 0.0)) file.Refuse("key 'dt'", "must be positive");
  if (!(mu >= 0.0)) file.Refuse("key 'mu'", "must not be negative");
  Start start;
  AddBodies(file, dt, result.theta, &result.problem, &start);
  result.body_count = file.Table("bodies", 10, false).size();
  AddContacts(file, result.body_count, mu, start, &result.problem);
  return result;
}

}  // namespace nscdd
