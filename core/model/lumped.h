#pragma once
#include "core/model/advice.h"
#include "core/model/campbell.h"
#include "core/model/chain_curves.h"
#include "core/model/dynamics_settings.h"
#include "core/model/frequency_response.h"
#include "core/model/given.h"
#include "core/model/material.h"
#include "core/model/pass.h"
#include <array>
#include <string>
#include <vector>

namespace mill {
/// A stand of any number of unknowns in files, as a run writes it into models/.
struct ModelFiles {
  std::string name = "detailed";  ///< "craig-bampton"
  std::string mass, stiffness;    ///< paths of Matrix Market files, (n, n) kg and N/m
  std::string force;              ///< (n, 1) force on each unknown per unit of bite force
  std::string readings;           ///< (p + 1, n) displacement of p places, then change of the load-cell force
  std::string names;              ///< CSV, what unknowns and readings are
  std::string connections;        ///< CSV, springs between the parts, which `stiffness` holds; empty: not known
  std::string strains;            ///< (r, n) strain of each of them per displacement
  double gap_damper      = not_given;        ///< N s/m, between the work rolls; NaN: none
  double frequency_limit = 1000;             ///< Hz, up to which its modes are right
  std::vector<std::array<double, 2>> modes;  ///< -, Hz: number and frequency of modes; to check the matrices by
  Place place;                               ///< of the section
};

/// kind = "lumped": starts at the lumped model.
struct Lumped {
  GivenValues given;      ///< masses and springs of the chain; empty where there is a model in files
  ChainCurves curves;     ///< of springs of the chain, for dynamics.contact = "curve"
  bool detailed = false;  ///< `model` is there, not the chain
  ModelFiles model;
  std::vector<Pass> passes;
  DynamicsSettings dynamics;
  FrequencyResponseSettings frequency_response;
  CampbellSettings campbell;
  std::vector<DriveOrder> drive;
  StandAdvice advice;
};
}  // namespace mill
