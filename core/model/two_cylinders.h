#pragma once
#include "core/model/contact_settings.h"
#include "core/model/material.h"

namespace mill {
/// kind = "two-cylinders": two long solid cylinders, plane strain.
struct TwoCylinders {
  Material steel;
  double upper_diameter = 0;  ///< m
  double lower_diameter = 0;  ///< m
  ContactSettings contact;
};
}  // namespace mill
