#pragma once
#include "core/base/each_member.h"
#include <Eigen/Core>
#include <vector>

// Dense contact mechanics: no mesh, no finite element.  theory.md 2
namespace mill::contact {
/// Frictionless unilateral contact of condensed bodies driven by k relative motions.  theory.md (2.6)
///     gap = initial_gap + C nodal + W resultant - G motion >= 0
///     nodal >= 0 ,   nodal . gap = 0 ,   G^T nodal = resultant
struct Problem {
  Eigen::MatrixXd C;            ///< (n, n) m/N, symmetric, positive definite
  Eigen::MatrixXd G;            ///< (n, k) closing of the gap per unit of each motion (1 for m, an arm for rad)
  Eigen::MatrixXd W;            ///< (n, k) gap opened by what balances a unit of each resultant; empty: zero
  Eigen::VectorXd initial_gap;  ///< (n) m
};

/// What is imposed on each of the k modes: its resultant (N, N m) or its motion (m, rad).
struct Loading {
  Eigen::VectorXd value;         ///< (k)
  std::vector<char> prescribed;  ///< (k) 1: the value is a motion; empty: all are resultants
};

struct State {
  Eigen::VectorXd motion;      ///< (k) m, rad
  Eigen::VectorXd resultant;   ///< (k) N, N m
  Eigen::VectorXd nodal;       ///< (n) N, >= 0
  Eigen::VectorXd gap;         ///< (n) m, >= 0
  Eigen::MatrixXd compliance;  ///< (k, k) d motion / d resultant, active set held: exact; infinite if undetermined
  Eigen::MatrixXd stiffness;   ///< (k, k) d resultant / d motion, active set held: exact; 0 without contact
  Eigen::MatrixXd d_nodal;     ///< (n, k) d nodal / d resultant, active set held
  std::vector<char> active;    ///< (n)
  int iterations  = 0;
  double residual = 0;  ///< -, largest violation of the four conditions, relative
};

template <class Io, class R, if_record<R, State> = 0> void each_member(Io &&io, R &record)
{
  auto &[motion, resultant, nodal, gap, compliance, stiffness, d_nodal, active, iterations, residual] = record;
  io("motion", motion);
  io("resultant", resultant);
  io("nodal", nodal);
  io("gap", gap);
  io("compliance", compliance);
  io("stiffness", stiffness);
  io("d_nodal", d_nodal);
  io("active", active);
  io("iterations", iterations);
  io("residual", residual);
}
}  // namespace mill::contact
