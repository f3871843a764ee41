// SPDX-License-Identifier: Apache-2.0
#include "nscdd/host/solver.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <type_traits>

#include "expect_error.h"
#include "layout.h"
#include "report_copy.h"
#include "validator/two_disk_host.h"

namespace nscdd {
namespace {

constexpr double kTimeStep = 0.05;

Solver Make(const std::string& name, const std::vector<std::pair<std::string, std::string>>& options,
            const nscdd_host* host = nullptr) {
  return Solver(PluginLibrary::Load(PLUGIN_FILE), {.solver = name, .options = options, .host = host, .communicator = {}});
}

// A column of `count` disks of radius 0.5 and mass 1 on a fixed body; contact k joins bodies k and k + 1.
ContactProblem Column(int count) {
  constexpr double kWeight = 9.81 * 0.01;
  const double infinite = std::numeric_limits<double>::infinity();
  ContactProblem p;
  p.mass.assign(static_cast<std::size_t>(count) + 1, 1.0);
  p.inertia.assign(p.mass.size(), 0.125);
  p.mass[0] = p.inertia[0] = infinite;
  p.free_velocity.assign(p.mass.size(), Twist{0.0, -kWeight, 0.0});
  p.impulse.assign(p.mass.size(), Wrench{0.0, -kWeight, 0.0});
  p.free_velocity[0] = {};
  p.impulse[0] = {};
  for (int k = 0; k < count; ++k) {
    p.contacts.a.push_back(k);
    p.contacts.b.push_back(k + 1);
    p.contacts.shape_a.push_back(0);
    p.contacts.shape_b.push_back(0);
    p.contacts.gap.push_back(0.0);
    p.contacts.normal.push_back({0.0, 1.0});
    p.contacts.lever_a.push_back(0.5);
    p.contacts.lever_b.push_back(0.5);
    p.contacts.site.push_back({0.0, static_cast<double>(k)});
    p.contacts.flat.push_back(0);
    p.contacts.friction.push_back(0.3);
    p.contacts.restitution.push_back(0.0);
    p.offset.push_back(0.0);
  }
  return p;
}

TEST(Solver, SolvesAColumnOnSeveralSubdomains) {
  const ContactProblem p = Column(4);
  const std::vector<std::pair<std::string, std::string>> sharp = {{"tolerance", "1e-12"}, {"max_iterations", "100000"}};
  auto options = sharp;
  options.emplace_back("subdomains", "1x2");
  const ContactSolution one = Make("nscd", sharp).Solve(p), two = Make("nscdd", options).Solve(p);
  EXPECT_EQ(one.report.subdomains, 1);
  EXPECT_EQ(two.report.subdomains, 2);
  EXPECT_EQ(two.report.interface_bodies, 1);
  EXPECT_EQ(two.report.max_multiplicity, 2);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(one.impulse[k].x, 9.81 * 0.01 * static_cast<double>(4 - k), 1e-9);
    EXPECT_NEAR(two.impulse[k].x, one.impulse[k].x, 1e-9);
  }
  EXPECT_EQ(one.report.status, SolveStatus::kConverged);
  EXPECT_GT(one.report.history.size(), 0u);
  EXPECT_EQ(one.report.history.back().iteration, one.report.iterations);
  EXPECT_EQ(one.report.history.back().nat, one.report.residuals.nat);
}

TEST(Solver, StartsWarm) {
  const ContactProblem p = Column(4);
  const ContactSolution cold = Make("nscd", {{"tolerance", "1e-10"}, {"acceleration", "none"}}).Solve(p);
  const ContactSolution warm = Make("nscd", {{"tolerance", "1e-9"}, {"acceleration", "none"}}).Solve(p, cold.impulse);
  EXPECT_LE(warm.report.iterations, 5);
  EXPECT_GT(cold.report.iterations, 5);
}

TEST(Solver, NeedsSitesForSeveralSubdomains) {
  Solver solver = Make("nscdd", {{"subdomains", "2x1"}});
  ContactProblem p = Column(1);
  p.contacts.site[0].x = std::numeric_limits<double>::quiet_NaN();
  ExpectError([&] { solver.Solve(p); }, {"contact 0", "site is not finite"});
  p.subdomain = {0};
  ExpectError([&] { solver.Solve(p); }, {"leave `subdomain` empty"});
}

TEST(Solver, SpeaksWhenItRefuses) {
  ExpectError([] { Make("nscd", {{"tolerance", "-1"}}); }, {"option 'tolerance' is '-1'"});
  ExpectError([] { Make("jacobi", {}); }, {"no solver 'jacobi'", "nscd, nscdd"});
  Solver solver = Make("nscd", {});
  ExpectError([&] { solver.Step(0.1); }, {"step", "without a host"});
  ExpectError([&] { solver.Report(); }, {"report", "call step or solve first"});
  ExpectError([&] { solver.Table("iterations"); }, {"table", "call step or solve first"});
  solver.Solve(Column(2));
  EXPECT_EQ(solver.Table("iterations").Integer("iteration").size(), solver.Table("iterations").rows());
  ExpectError([&] { solver.Table("bodies"); }, {"'bodies' is there after a step"});
  ExpectError([&] { solver.Table("iterations").Real("colour"); }, {"no column 'colour'"});
  ExpectError([&] { solver.Table("iterations").Real("iteration"); }, {"integer, not real"});
}

TEST(Solver, KeepsThePluginLoaded) {
  TwoDiskHost host;
  auto library = PluginLibrary::Load(PLUGIN_FILE);
  Solver solver(library, {.solver = "nscd", .options = {}, .host = host.table(), .communicator = {}});
  library.reset();
  solver.Step(kTimeStep);
  EXPECT_EQ(host.commits(), 1);
}

TEST(Solver, RefusesACommunicatorWithoutMpi) {
  ExpectError(
      [] {
        Solver solver(PluginLibrary::Load(PLUGIN_FILE), {.solver = "nscd", .options = {}, .host = nullptr, .communicator = 0});
      },
      {"MPI is not running"});
}

TEST(Solver, ShowsTablesOfAStep) {
  TwoDiskHost host;
  Solver solver = Make("nscd", {{"alert_distance", "5"}}, host.table());
  solver.Step(kTimeStep);
  const TableView bodies = solver.Table("bodies");
  ASSERT_EQ(bodies.rows(), 2u);
  EXPECT_EQ(bodies.Integer("id")[0], 3);
  EXPECT_EQ(bodies.Real("x")[0], host.pose()[0]);
  EXPECT_EQ(bodies.Real("vx")[1], host.velocity()[3]);
  const TableView contacts = solver.Table("contacts");
  ASSERT_EQ(contacts.rows(), 1u);
  EXPECT_EQ(contacts.Integer("body_b")[0], 7);
  EXPECT_EQ(contacts.Integer("status")[0], 0);
  EXPECT_NEAR(contacts.Real("final_gap")[0], host.gap(), 1e-14);
  const StepReport report = solver.Report();
  EXPECT_EQ(report.bodies, 2);
  EXPECT_EQ(report.alert_distance, 5.0);
  EXPECT_NEAR(report.kinetic_energy, TwoDiskHost::kMass, 1e-12);
  EXPECT_NEAR(report.time, kTimeStep, 1e-15);
}

// A host that calls the plugin again while the plugin calls it.
TEST(Solver, RefusesToBeReentered) {
  struct Context {
    TwoDiskHost inner;
    const nscdd_host* inner_table = nullptr;
    Solver* solver = nullptr;
    bool refused = false;
  } context;
  context.inner_table = context.inner.table();
  nscdd_host table = *context.inner_table;
  table.user = &context;
  table.describe = [](void* u, nscdd_host_description* d) {
    auto* c = static_cast<Context*>(u);
    return c->inner_table->describe(c->inner_table->user, d);
  };
  table.read_bodies = [](void* u, nscdd_bodies* b) {
    auto* c = static_cast<Context*>(u);
    try {
      c->solver->Step(kTimeStep);
    } catch (const Error&) {
      c->refused = true;
    }
    return c->inner_table->read_bodies(c->inner_table->user, b);
  };
  table.detect_contacts = [](void* u, std::uint64_t n, const std::int64_t* id, const double* q, double alert,
                             nscdd_contacts* t) {
    auto* c = static_cast<Context*>(u);
    return c->inner_table->detect_contacts(c->inner_table->user, n, id, q, alert, t);
  };
  table.commit = [](void* u, const nscdd_step_result* r) {
    auto* c = static_cast<Context*>(u);
    return c->inner_table->commit(c->inner_table->user, r);
  };
  Solver solver = Make("nscd", {}, &table);
  context.solver = &solver;
  solver.Step(kTimeStep);
  EXPECT_TRUE(context.refused);
  EXPECT_EQ(context.inner.commits(), 1);
}

TEST(Report, CrossesTheInterfaceUnchanged) {
  StepReport sent;
  std::int64_t count = 100;
  const auto fill = [&](const Figure&, auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_arithmetic_v<Value>) value = static_cast<Value>(++count) / 2;
  };
  ForEachFigure(fill, sent);
  sent.solve.status = SolveStatus::kStalled;
  sent.solve.reason = "why";
  auto crossing = WithHeader<nscdd_report>();
  crossing.header.abi_minor = NSCDD_ABI_MINOR;
  CopyReport(sent, &crossing);
  EXPECT_STREQ(crossing.reason, "why");
  const auto same = [](const Figure& figure, const auto& here, const auto& there) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(here)>>) {
      EXPECT_EQ(here, there) << figure.name;
    }
  };
  ForEachFigure(same, sent, crossing);
}

// Figures were appended to nscdd_report since: what an older host did not reserve must not be written.
TEST(Report, OfAnOlderHostIsNotOverrun) {
  StepReport sent;
  sent.solve.extrapolations = 5;
  sent.solve.acceleration_restarts = 6;
  auto target = WithHeader<nscdd_report>();
  target.header.struct_size = offsetof(nscdd_report, acceleration_restarts);
  target.acceleration_restarts = -1;
  CopyReport(sent, &target);
  EXPECT_EQ(target.extrapolations, 5);
  EXPECT_EQ(target.acceleration_restarts, -1);
  EXPECT_EQ(ReportSize(0), ReportSize(2));
  EXPECT_EQ(ReportSize(NSCDD_ABI_MINOR), sizeof(nscdd_report));
}

// A status that a later plugin may know is not taken for success.
TEST(Report, OfAnUnknownStatusIsNoSuccess) {
  setenv("NSCDD_FAULT", "new_status", 1);
  const auto library = PluginLibrary::Load(std::string(BAD_FOLDER) + "/faulty_plugin.so");
  unsetenv("NSCDD_FAULT");
  Solver solver(library, {.solver = "nscd", .options = {}, .host = nullptr, .communicator = {}});
  EXPECT_EQ(solver.Solve(Column(4)).report.status, SolveStatus::kDiverged);
}

// The header of its report says what a host knows; hosts of ABI 1.0 and 1.1 have no NSCDD_FIXED.
TEST(Solver, OlderHostsAreToldAnIterationLimit) {
  const auto library = PluginLibrary::Load(PLUGIN_FILE);
  const nscdd_plugin& plugin = library->plugin();
  const char* names[] = {"tolerance", "max_iterations"};
  const char* values[] = {"0", "3"};
  auto create = WithHeader<nscdd_create_arguments>();
  create.solver = "nscd";
  create.option_count = 2;
  create.option_names = names;
  create.option_values = values;
  nscdd_solver* solver = nullptr;
  ASSERT_EQ(plugin.create(&create, &solver, nullptr, 0), NSCDD_OK);
  const ContactProblem p = Column(4);
  auto problem = WithHeader<nscdd_problem>();
  problem.body_count = p.mass.size();
  problem.mass = p.mass.data();
  problem.inertia = p.inertia.data();
  problem.free_velocity = AsDoubles(p.free_velocity.data());
  problem.impulse = AsDoubles(p.impulse.data());
  problem.contacts = ShowContacts(p.contacts);
  problem.offset = p.offset.data();
  std::vector<double> velocity(3 * p.mass.size()), impulse(2 * p.contacts.size());
  auto solution = WithHeader<nscdd_solution>();
  solution.velocity = velocity.data();
  solution.impulse = impulse.data();
  ASSERT_EQ(plugin.solve(solver, &problem, &solution), NSCDD_OK);
  for (const std::uint32_t minor : {0u, 1u, 2u}) {
    auto report = WithHeader<nscdd_report>();
    report.header.abi_minor = minor;
    ASSERT_EQ(plugin.report(solver, &report), NSCDD_OK);
    EXPECT_EQ(report.status, minor < 2 ? NSCDD_ITERATION_LIMIT : NSCDD_FIXED);
  }
  plugin.destroy(solver);
  EXPECT_EQ(Make("nscd", {{"tolerance", "0"}, {"max_iterations", "3"}}).Solve(p).report.status, SolveStatus::kFixed);
}

}  // namespace
}  // namespace nscdd
