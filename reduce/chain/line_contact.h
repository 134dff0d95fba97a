#pragma once
#include "core/model/material.h"

namespace mill::reduce {
/// Two solid cylinders of one material with parallel axes, each loaded diametrally.
struct CylinderPair {
  double diameter1 = 0;  ///< m
  double diameter2 = 0;  ///< m
  double length    = 0;  ///< m, of the contact line
  Material material;
};

/// Hertz pressure and Johnson's approach of one cylinder pair at one load.  theory.md 3.1
struct LineContact {
  double half_width;     ///< m, (3.2)
  double peak_pressure;  ///< Pa, (3.3)
  double approach;       ///< m, the two axes towards each other, (3.4)
  double secant;         ///< N/m, load / approach, (3.5a)
  double tangent;        ///< N/m, d(load)/d(approach), (3.5b)
};

/// Approach of the two axes under `load` (N, total, > 0) with its slopes, in closed form.
/// Plane strain, parabolic gap, no end effects: what a contact computation of two long rolls has to meet.
/// @throws InputError  load, a diameter or the length not positive
/// Cost O(1).  Source: K. L. Johnson, Contact Mechanics (1985), eq. 4.42-4.45 and 5.57.
LineContact line_contact(const CylinderPair &pair, double load);

/// Secant stiffness F/approach of the same pair by four laws that differ only in what they take as datum.
/// Their spread is the accuracy with which "the" stiffness of a line contact is defined.  theory.md 3.3
struct SecantLaws {
  double johnson;     ///< N/m, axis to axis, Hertz pressure, (3.5a)
  double foeppl;      ///< N/m, axis to axis, parabolic pressure, (3.8)
  double half_space;  ///< N/m, larger roll as a half space as deep as the contact is long, (3.9)
  double palmgren;    ///< N/m, fit to tests with steel rollers; independent of diameter and material, (3.10)
};

/// The four secants at `load` (N).  Errors and cost as line_contact.
SecantLaws secant_laws(const CylinderPair &pair, double load);
}  // namespace mill::reduce
