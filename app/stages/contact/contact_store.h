#pragma once
#include "app/stages/contact/contact_model.h"
#include "app/stages/contact/fourier_stage.h"
#include "core/base/each_member.h"
#include "core/records/records.h"
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace mill {
struct FourHigh;

/// What is read off a pair, and its loads that are solved.
struct SolvedPair {
  fem::ContactPair pair;
  fem::SolvedLoads::Known loads;
};

template <class Io, class R, if_record<R, SolvedPair> = 0> void each_member(Io &&io, R &record)
{
  auto &[pair, loads] = record;
  io("pair", pair);
  io("loads", loads);
}

/// Everything that was solved of one contact: its curves, the Fourier solver's, single loads of every pair, and
/// what is read off a pair; not the rolls and the compliances made of them, which only another load needs.
struct SolvedStudy {
  ContactCurve mirrored, in_stand, coarse, in_stand_coarse;
  std::optional<fem::SecondEngine> second;
  std::vector<SolvedPair> pairs;    ///< of all_pairs(), in their order
  std::vector<std::string> fields;  ///< VTU files of backup roll and work roll
};

template <class Io, class R, if_record<R, SolvedStudy> = 0> void each_member(Io &&io, R &record)
{
  auto &[mirrored, in_stand, coarse, in_stand_coarse, second, pairs, fields] = record;
  io("mirrored", mirrored);
  io("in_stand", in_stand);
  io("coarse", coarse);
  io("in_stand_coarse", in_stand_coarse);
  io("second", second);
  io("pairs", pairs);
  io("fields", fields);
}

/// Everything that it depends on, as text; its hash is the key of the cache.
/// @param loads  (passes) N, working loads
std::string contact_inputs(const FourHigh &stand, const std::string &name, const ContactSettings &settings,
                           const std::vector<double> &loads);
}  // namespace mill
