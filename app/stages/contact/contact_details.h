#pragma once
#include "app/stages/contact/contact_model.h"
#include "core/base/warning.h"
#include "core/model/contact_settings.h"

namespace mill {
struct FourHigh;

/// A warning of the contact "upper" or "lower".
Warning of_contact(WarningId id, const std::string &name, std::string fact, std::string detail);

/// What one working load of a contact gives beyond its stiffness: the length in contact, the published way of
/// evaluating (K.path_plateau), the joint stiffness between the axes, the pressure map
/// (curves/contact-<name>-pressure.csv), and warnings about what the model does not hold for.
/// @param largest  N, largest load that the meshes are made for
/// @param tangent  K.tangent of this load
void add_contact_details(RunContext &run, const ContactModel &model, const std::string &name, const std::string &K,
                         const FourHigh &stand, const ContactSettings &settings, double load, double largest,
                         const fem::Compared &tangent);

/// The mesh must resolve the contact at this load; below two elements over the half width the run warns.
/// @throws InputError  not even one element over the half width; says how many elements would do
void require_resolved(RunContext &run, const ContactModel &model, const std::string &name,
                      const ContactSettings &settings, double load);
}  // namespace mill
