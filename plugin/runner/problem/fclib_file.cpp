// SPDX-License-Identifier: Apache-2.0
#include "problem/problem_file.h"

#include <fmt/format.h>

#include "nscdd/contact_operators.h"
#include "nscdd/error.h"
#include "results/hdf5_file.h"
#include "results/written_file.h"

namespace nscdd {
namespace {

constexpr const char* kMathInfo =
    "u = H^T v + w per contact in the order (n, t), r likewise; r_n >= 0 is compression, u_n > 0 opens, t = (n_y, -n_x). The "
    "gaps enter "
    "through w alone: u_n = v_n + b_n with b_n [m/s] = max(0, gap) / dt (other normal laws and restitution change b_n, not the "
    "law "
    "0 <= u_n _|_ r_n >= 0), so w_n = b_n plus what prescribed bodies do, w_t the latter. M is diagonal and positive, W "
    "symmetric "
    "and positive semi-definite; with more contacts than bodies bear (hyperstatic) r is not unique.";

/// Data sets of one file, which lie on one rank.
class FclibWriter {
 public:
  explicit FclibWriter(const std::filesystem::path& path) : file_(Hdf5File::Create(path, ranks_)) {}

  Hdf5Handle Group(const std::string& name) { return file_.CreateGroup(name); }
  template <class T>
  void Put(const Hdf5Handle& group, const char* name, const std::vector<T>& values) {
    file_.WriteColumn(group, name, "", values, RowRange(ranks_, values.size()));
  }
  void Put(const Hdf5Handle& group, const char* name, std::int32_t value) {
    Put(group, name, std::vector<std::int32_t>{value});
  }
  void Put(const Hdf5Handle& group, const char* name, const std::string& text) { file_.WriteText(group, name, text); }

  void PutMatrix(const std::string& name, const SparseMatrix& matrix) {
    const Hdf5Handle group = Group(name);
    Put(group, "nzmax", static_cast<std::int32_t>(matrix.row.size()));
    Put(group, "m", matrix.rows);
    Put(group, "n", matrix.columns());
    Put(group, "nz", -1);  // compressed columns
    Put(group, "p", matrix.start);
    Put(group, "i", matrix.row);
    Put(group, "x", matrix.value);
  }

  void PutInfo(const std::string& name, const std::string& title, const std::string& description) {
    const Hdf5Handle group = Group(name);
    Put(group, "title", title);
    Put(group, "description", description);
    Put(group, "math_info", std::string(kMathInfo));
  }

  void Close() { file_.Close(); }

 private:
  RankGroup ranks_;
  Hdf5File file_;
};

std::vector<double> Interleaved(const std::vector<Vec2>& pairs) {
  std::vector<double> numbers;
  for (const Vec2& pair : pairs) numbers.insert(numbers.end(), {pair.x, pair.y});
  return numbers;
}

void PutGlobal(const ContactOperators& o, const std::vector<double>& friction, const std::string& title,
               const std::string& description, FclibWriter* out) {
  out->Put(out->Group("/fclib_global"), "spacedim", 2);
  out->PutMatrix("/fclib_global/M", o.mass);
  out->PutMatrix("/fclib_global/H", o.transfer);
  const Hdf5Handle vectors = out->Group("/fclib_global/vectors");
  out->Put(vectors, "f", o.momentum);
  out->Put(vectors, "w", o.offset);
  out->Put(vectors, "mu", friction);
  out->PutInfo("/fclib_global/info", title, description);
}

void PutLocal(const ContactOperators& o, const std::vector<double>& friction, const std::string& title,
              const std::string& description, FclibWriter* out) {
  out->Put(out->Group("/fclib_local"), "spacedim", 2);
  out->PutMatrix("/fclib_local/W", o.delassus);
  const Hdf5Handle vectors = out->Group("/fclib_local/vectors");
  out->Put(vectors, "q", o.free_velocity);
  out->Put(vectors, "mu", friction);
  out->PutInfo("/fclib_local/info", title, description);
}

void PutAnswer(const ContactProblem& problem, const ContactSolution& answer, FclibWriter* out) {
  const bool converged = answer.report.status == SolveStatus::kConverged;
  if (!converged) out->Put(out->Group("/guesses"), "number_of_guesses", 1);
  const Hdf5Handle group = out->Group(converged ? "/solution" : "/guesses/1");
  out->Put(group, "v", FreeRows(problem, answer.velocity));
  out->Put(group, "u", LocalVelocities(problem, answer.velocity));
  out->Put(group, "r", Interleaved(answer.impulse));
}

}  // namespace

void WriteFclibFile(const std::filesystem::path& path, const std::string& title, const std::string& description,
                    const ContactProblem& problem, const ContactSolution& answer) {
  if (problem.contacts.size() == 0)
    throw Error(fmt::format("{}: there is no contact to write; choose a later step", path.string()));
  const ContactOperators operators = MakeContactOperators(problem);
  const Hdf5Silence silence;
  ReplacedFile file(path);
  FclibWriter out(file.part());
  PutGlobal(operators, problem.contacts.friction, title, description, &out);
  PutLocal(operators, problem.contacts.friction, title, description, &out);
  PutAnswer(problem, answer, &out);
  out.Close();
  file.Commit();
}

}  // namespace nscdd
