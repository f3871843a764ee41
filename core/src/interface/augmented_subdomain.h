// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nscdd/options.h"
#include "problem/subdomain_problem.h"

namespace nscdd {

/// One subdomain in the augmented interface problem: the operator
///     M_lambda,E = M~_E + Lambda G_E G_E^T     (symmetric positive definite for every lambda >= 0; eq. (12) of the paper)
/// on the velocities of its free copies ("nodes"). G_E has the columns of H_E that the compatibility names, of contacts that
/// are active now. Prescribed copies have no node: their velocities are known. With normals of disks alone the spins decouple
/// from it, and a node has 2 unknowns instead of 3 (their interface problem is the plain mean).
class AugmentedSubdomain {
 public:
  /// `reference_mass` [kg] is what lambda multiplies with LambdaScale::kMass. `restoring` [m/s], per contact of the subdomain
  /// or empty, is added to v_E on normals.
  AugmentedSubdomain(const SubdomainProblem& problem, const AugmentedInterfaceOptions& options, double reference_mass,
                     std::vector<double> restoring = {});

  int dofs() const { return dofs_; }
  int nodes() const { return static_cast<int>(copy_of_node_.size()); }
  int NodeOf(std::int32_t copy) const { return node_of_copy_[copy]; }  ///< -1: prescribed
  std::int32_t CopyOf(int node) const { return copy_of_node_[node]; }

  /// Unknowns of dofs each per node that a model and compatibility need.
  static int DofsFor(ContactModel model, Compatibility compatibility);

  /// Chooses the columns of G_E from the impulses.
  void ChooseColumns(const SubdomainState& state);

  /// Triplets of the lower triangle, for all candidate contacts; node i becomes number[i].
  void AppendPattern(std::span<const std::int32_t> number, std::vector<std::int32_t>* row,
                     std::vector<std::int32_t>* column) const;
  /// Their values with the columns of now.
  void AppendValues(std::span<const std::int32_t> number, std::vector<double>* values) const;

  /// M~_E V_E + Lambda G_E (v_E - v_p), dofs per node: y_E of eq. (13) less the interface impulse. v_E by the option
  /// local_velocity; `left` holds the tangential velocities that the local solves left (per contact), if they are needed; v_p
  /// is the part of prescribed bodies.
  std::vector<double> RightHandSide(const SubdomainState& state, std::span<const double> left) const;

  /// Change of the interface impulse that goes with the solution V~ (dofs per node), dF_E = M~_E (V_E - V~) + Lambda G_E (v_E -
  /// G^T V~).
  std::vector<double> ImpulseChange(const SubdomainState& state, std::span<const double> left,
                                    std::span<const double> solution) const;

  /// M_lambda,E x.
  std::vector<double> Multiply(std::span<const double> x) const;
  std::vector<double> Diagonal() const;

 private:
  /// A column of G_E with Lambda: g^T V = ga . V_A + gb . V_B.
  struct Column {
    std::int32_t a, b;  // copies
    double weight;      // Lambda [kg]; 0: not active
    double ga[3], gb[3];
    double velocity_known;  // local velocity where the law tells it: -b_n on normals, 0 on sticking tangents
    bool is_known;
    std::int32_t contact;
    bool is_normal;
  };
  template <class Row>
  void MakeColumns(const std::vector<Row>& rows, LambdaScale scale, double lambda, double reference_mass);
  double PrescribedPart(const Column& c, const SubdomainState& state) const;
  double OldVelocity(const Column& c, const SubdomainState& state, std::span<const double> left) const;
  double Dot(const Column& c, std::span<const double> nodes) const;
  void Add(const Column& c, double factor, std::vector<double>* nodes) const;
  double MassOf(int node, int dof) const;

  const SubdomainProblem& problem_;
  Compatibility compatibility_;
  StatusCompatibility status_compatibility_;
  LocalVelocity local_velocity_;
  int dofs_;
  std::vector<std::int32_t> node_of_copy_, copy_of_node_;
  std::vector<Column> columns_;  // of every candidate contact: its normal, then its tangent if the compatibility has tangents
  std::vector<double> full_weight_;
  std::vector<double> restoring_;
};

}  // namespace nscdd
