// SPDX-License-Identifier: Apache-2.0
#include "problem/problem_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nscdd/error.h"
#include "nscdd/step_problem.h"
#include "results/written_file.h"
#include "scene/text.h"

namespace nscdd {
namespace {

using Json = nlohmann::json;
constexpr double kRounded = 1e-9;    // off unit length by so much is fine for the solver
constexpr double kFewDigits = 1e-3;  // off unit length as numbers of few digits are

/// The file as JSON, with sentences for what is missing.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : name_(path.string()) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
      throw Error(fmt::format("{}: is a folder; give a problem file (JSON)", name_));
    std::ifstream in(path);
    if (!in) throw Error(fmt::format("{}: the file cannot be opened; check the path", name_));
    try {
      json_ = Json::parse(in);
    } catch (const Json::exception& e) {
      throw Error(fmt::format("{}: not valid JSON: {}", name_, Printable(e.what())));
    }
    if (!json_.is_object()) Refuse("the file", "is not an object; write {\"dt\": ..., \"bodies\": [...], ...}");
    RefuseMisspeltKeys();
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

  /// The same, optional, with `count` rows, one for each `what`.
  std::vector<std::vector<double>> TableOf(const char* key, std::size_t columns, std::size_t count, const char* what) const {
    auto rows = Table(key, columns, true);
    if (json_.contains(key) && rows.size() != count) {
      Refuse(fmt::format("key '{}'", key),
             fmt::format("has {} rows; it needs one for each {}, {} in all", rows.size(), what, count));
    }
    return rows;
  }

  /// One number for all of `count`, or a list with one for each; zero if the key is missing.
  std::vector<double> NumberOrRow(const char* key, std::size_t count) const {
    const auto at = json_.find(key);
    if (at == json_.end() || !at->is_array()) return std::vector<double>(count, Number(key, 0.0));
    if (at->size() != count)
      Refuse(fmt::format("key '{}'", key), fmt::format("has {} numbers, {} are needed", at->size(), count));
    return Row(*at, fmt::format("key '{}'", key), count);
  }

  const Json& json() const { return json_; }
  const std::string& name() const { return name_; }

 private:
  /// Other keys may be there (a stored solution, say), but not one that looks like a key that would be read.
  void RefuseMisspeltKeys() const {
    static const std::vector<std::string> known = {"dt",       "theta",  "gravity", "mu",   "bodies",
                                                   "contacts", "planes", "forces",  "arms", "sites"};
    for (const auto& [key, value] : json_.items()) {
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      const std::string nearest = NearestName(key, known);
      if (!nearest.empty())
        Refuse(fmt::format("key '{}'", Printable(key)), fmt::format("is not known; did you mean '{}'?", nearest));
    }
  }

  double ToNumber(const Json& value, const std::string& where) const {
    if (!value.is_number()) Refuse(where, fmt::format("holds {} where a number is needed", value.type_name()));
    const double number = value.get<double>();
    if (!std::isfinite(number)) Refuse(where, "holds a number that is not finite");
    return number;
  }

  std::string name_;
  Json json_;
};

/// The bodies at the beginning, planes behind the others. The problem gets what a step makes of them.
BodyTable AddBodies(const Reader& file, double dt, ContactProblem* problem) {
  const auto gravity = file.Row(file.json().value("gravity", Json::array({0.0, 0.0})), "key 'gravity'", 2);
  const auto bodies = file.Table("bodies", 10, false);
  const auto forces = file.TableOf("forces", 3, bodies.size(), "body");
  BodyTable table;
  table.Resize(bodies.size() + file.Table("planes", 3, true).size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    const bool plane = i >= bodies.size();
    table.kind[i] = plane || bodies[i][9] != 0.0 ? BodyKind::kPrescribed : BodyKind::kFree;
    if (plane) continue;
    const auto& b = bodies[i];
    if (table.kind[i] == BodyKind::kFree && (!(b[7] > 0.0) || !(b[8] > 0.0))) {
      file.Refuse(fmt::format("'bodies' row {}", i), "has a mass or inertia that is not positive");
    }
    table.pose[i] = {b[0], b[1], b[2]};
    table.velocity[i] = {b[3], b[4], b[5]};
    table.mass[i] = b[7];
    table.inertia[i] = b[8];
    Wrench& f = table.force[i] = {b[7] * gravity[0], b[7] * gravity[1], 0.0};
    if (!forces.empty()) f = {f.fx + forces[i][0], f.fy + forces[i][1], f.torque + forces[i][2]};
  }
  SteppingOptions one_stage;  // b_n stands in the file; V_f is that of every body
  one_stage.normal_law = NormalLaw::kGap;
  *problem = PoseStep(table, {}, {}, one_stage, dt);
  return table;
}

std::int32_t BodyRow(const Reader& file, double number, std::size_t contact, std::size_t bodies, std::size_t all) {
  const double row = number < 0.0 ? static_cast<double>(bodies) - 1.0 - number : number;
  if (row != std::floor(row) || !(row < static_cast<double>(all)) || (number >= 0.0 && row >= static_cast<double>(bodies))) {
    file.Refuse(fmt::format("'contacts' row {}", contact),
                fmt::format("names body or plane {}; there are {} bodies and {} planes", number, bodies, all - bodies));
  }
  return static_cast<std::int32_t>(row);
}

/// Arms and sites of the contacts, where the file gives them.
void AddPlaces(const Reader& file, ContactTable* t) {
  for (const auto& arms : file.TableOf("arms", 4, t->size(), "contact")) {
    t->arm_a.push_back({arms[0], arms[1]});
    t->arm_b.push_back({arms[2], arms[3]});
  }
  const auto sites = file.TableOf("sites", 2, t->size(), "contact");
  for (std::size_t c = 0; c < sites.size(); ++c) t->site[c] = {sites[c][0], sites[c][1]};
}

/// Unit normals of the contacts' rows, where numbers of few digits were meant for such; others stay as they are, to be refused.
std::vector<Vec2> NormalsOf(const Reader& file, const std::vector<std::vector<double>>& contacts, Notes* notes) {
  std::vector<Vec2> normals;
  std::size_t mended = 0;
  double farthest = 0.0;
  for (const auto& row : contacts) {
    Vec2 n{row[2], row[3]};
    const double length = Norm(n), off = std::abs(length - 1.0);
    if (off > kRounded && off < kFewDigits) {
      n = {n.x / length, n.y / length};
      ++mended;
      farthest = std::max(farthest, off);
    }
    normals.push_back(n);
  }
  if (mended > 0) {
    notes->sentences.push_back(
        fmt::format("{}: {} of {} normals in 'contacts' were off unit length by up to {:.1e}, and were normalised; "
                    "write numbers with 17 digits.",
                    file.name(), mended, contacts.size(), farthest));
  }
  return normals;
}

/// `start`: all bodies; `detection`: where the contacts are sought.
void AddContacts(const Reader& file, std::size_t bodies, const BodyTable& start, const std::vector<Pose>& detection,
                 ContactProblem* problem, Notes* notes) {
  ContactTable& t = problem->contacts;
  const auto contacts = file.Table("contacts", 8, false);
  t.friction = file.NumberOrRow("mu", contacts.size());
  const std::vector<Vec2> normals = NormalsOf(file, contacts, notes);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto& row = contacts[c];
    const std::int32_t b = BodyRow(file, row[0], c, bodies, problem->mass.size());
    const std::int32_t a = BodyRow(file, row[1], c, bodies, problem->mass.size());
    const Vec2 n = normals[c];
    t.a.push_back(a);
    t.b.push_back(b);
    t.normal.push_back(n);
    t.gap.push_back(row[4]);
    t.lever_b.push_back(row[5]);
    t.lever_a.push_back(row[6]);
    t.restitution.push_back(0.0);  // is in b_n already
    t.flat.push_back(0);
    const Vec2 centre = Centre(detection[b]);
    const bool plane = a >= static_cast<std::int32_t>(bodies);
    t.site.push_back(plane ? centre - row[5] * n : 0.5 * (centre + Centre(detection[a])));
    problem->offset.push_back(row[7]);
  }
  AddPlaces(file, &t);
  for (std::size_t c = 0; c < t.size(); ++c) {
    const double vn = RelativeVelocity(KinematicsOf(t, c), start.velocity[t.a[c]], start.velocity[t.b[c]]).x;
    problem->approach_speed = std::max(problem->approach_speed, -vn);
  }
}

}  // namespace

ProblemFile ReadProblemFile(const std::filesystem::path& path) {
  const Reader file(path);
  ProblemFile result;
  const double dt = file.Number("dt");
  result.theta = file.Number("theta", 0.5);
  if (!(dt > 0.0)) file.Refuse("key 'dt'", "must be positive");
  const BodyTable start = AddBodies(file, dt, &result.problem);
  const auto detection = Drifted(start.pose, start.velocity, (1.0 - result.theta) * dt, {});
  result.body_count = file.Table("bodies", 10, false).size();
  AddContacts(file, result.body_count, start, detection, &result.problem, &result.notes);
  for (const double mu : result.problem.contacts.friction) {
    if (!(mu >= 0.0)) file.Refuse("key 'mu'", "must not be negative");
  }
  return result;
}

void WriteProblemFile(const std::filesystem::path& path, const RecordedStep& step, double dt, double theta) {
  const BodyTable& b = step.bodies;
  const ContactTable& t = step.problem.contacts;
  nlohmann::ordered_json json = {{"dt", dt}, {"theta", theta}, {"mu", t.friction}};
  for (const char* key : {"bodies", "forces", "contacts", "sites"}) json[key] = Json::array();
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Pose& q = b.pose[i];
    const Twist& v = b.velocity[i];
    const bool fixed = b.kind[i] != BodyKind::kFree;
    json["bodies"].push_back({q.x, q.y, q.angle, v.vx, v.vy, v.spin, b.radius[i], fixed ? 1.0 : b.mass[i],
                              fixed ? 1.0 : b.inertia[i], fixed ? 1 : 0});
    const Wrench f = fixed ? Wrench{} : b.force[i];
    json["forces"].push_back({f.fx, f.fy, f.torque});
  }
  for (std::size_t c = 0; c < t.size(); ++c) {
    json["contacts"].push_back(
        {t.b[c], t.a[c], t.normal[c].x, t.normal[c].y, t.gap[c], t.lever_b[c], t.lever_a[c], step.problem.offset[c]});
    json["sites"].push_back({t.site[c].x, t.site[c].y});
    if (t.has_arms()) json["arms"].push_back({t.arm_a[c].x, t.arm_a[c].y, t.arm_b[c].x, t.arm_b[c].y});
  }
  ReplaceText(path, json.dump() + '\n');
}

}  // namespace nscdd
