#pragma once
#include "report/page/run.h"
#include <string>
#include <vector>

namespace mill::report {
/// What a result is, in words of its row: "K3.tangent" -> "upper backup roll on upper work roll, tangent dF/dδ".
/// Empty when no row makes the name.
std::string meaning_of(const std::string &name);

/// The value that represents K1..K7, Kzc1..Kzc4: the entry of that name, else its tangent, which is what a
/// vibrating mill feels, else its combined value.  nullptr when the run has none.
const Result *chain_value(const Run &run, const std::string &name);

struct Group {
  std::string title;
  std::vector<const Result *> results;
};

/// The numbers of the short table, in the order of the load path; empty groups are left out.
std::vector<Group> short_groups(const Run &run);

/// Every result of a run of one bearing by what it is about: stiffness, rows, rollers, motion, others.  Empty
/// groups are left out; an unforeseen "Kzc.*" is taken as a stiffness.
std::vector<Group> bearing_groups(const Run &run);
/// Results of a run of kind "bite": K4, then every pass by the model that gives it.
std::vector<Group> bite_groups(const Run &run);
/// Of every condition or pass that chatter was computed of.
std::vector<Group> condition_groups(const Run &run);
/// What one asks for first in a run of kind "chatter": of every condition, then of its bite.
std::vector<Group> chatter_groups(const Run &run);
/// What one asks for first: force, named frequencies and limits of every pass, what was fitted.
std::vector<Group> cluster_groups(const Run &run);
/// What one asks for first in a run of kind "stack": strip and stack, contacts, influences.
std::vector<Group> stack_groups(const Run &run);
/// chatter.CONDITION.speed_slope.KEY and friction_slope, which the charts of the section show side by side.
bool is_slope_by_one_input(const std::string &name);
/// bite.PASS.MODEL.*, which the table of models shows side by side.
bool is_of_one_model(const std::string &name);

/// "upper" -> "upper contact (K3)".
std::string contact_title(const std::string &contact);
}  // namespace mill::report
