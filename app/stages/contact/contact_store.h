#pragma once
#include "app/stages/contact/contact_model.h"
#include "app/stages/contact/fourier_stage.h"
#include "core/records/records.h"
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace mill {
struct FourHigh;

/// Everything that was solved of one contact: its curves, the Fourier solver's, single loads of every pair, and
/// what is read off a pair; not the rolls and the compliances made of them, which only another load needs.
struct SolvedStudy {
  ContactCurve mirrored, in_stand, coarse, in_stand_coarse;
  std::optional<SecondEngine> second;
  std::vector<fem::SolvedLoads::Known> known;  ///< of all_pairs(), in their order
  std::vector<fem::ContactPair> pairs;         ///< the same, without `problem`
  std::vector<std::string> fields;             ///< VTU files of backup roll and work roll
};

/// Everything that it depends on, as text; its hash is the key of the cache.
/// @param loads  (passes) N, working loads
std::string contact_inputs(const FourHigh &stand, const std::string &name, const ContactSettings &settings,
                           const std::vector<double> &loads);

/// @throws InputError  cannot be written
void save_study(const std::string &path, const std::string &key, const SolvedStudy &study);
/// What was kept, or nothing; `note` says why an entry cannot be used.
std::optional<SolvedStudy> load_study(const std::string &path, const std::string &key, std::string *note);
}  // namespace mill
