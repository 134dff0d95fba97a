#include "twin/live/compare/proposals.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/force_text.h"
#include "core/case/lumped_model_toml.h"
#include "core/model/case.h"
#include "core/records/number_in_chain.h"
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fstream>
#include <numeric>
#include <utility>

namespace mill::live {
namespace {
std::string utc_text(const double utc)
{
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time_t(utc)));
}

std::string file_time(const double utc)
{
  return fmt::format("{:%Y%m%dT%H%M%SZ}", fmt::gmtime(std::time_t(utc)));
}

// The spring of this name; nullptr: the name is of a damping ratio.
template <class Model> auto spring_of(Model &chain, const std::string &name) -> decltype(&chain.K[0])
{
  const auto number = choice_named<ChainNumber>(name);
  return number && is_spring_of_chain(*number) ? number_in_chain(chain, *number) : nullptr;
}

// Aside and renamed.  A log that is there and cannot be read is not replaced.
void append_line(const std::string &log, const std::string &line)
{
  const auto before = text_if_readable(log);
  std::error_code error;
  if (!before && std::filesystem::exists(log, error))
    refuse_file(EACCES, log + " cannot be read, and is needed to add to it");
  write_atomically(log, before.value_or("") + line);
}

// A name that nothing has yet: two proposals of one second stay apart.
std::string free_name(const std::string &folder, const double utc)
{
  const std::string stem = folder + "/calibrated-" + file_time(utc);
  std::string name       = stem + ".toml";
  for (int i = 2; std::filesystem::exists(name); ++i)
    name = fmt::format("{}-{}.toml", stem, i);
  return name;
}
}  // namespace

LumpedModel recalibrated(LumpedModel chain, const twin::Recalibration &recalibration, const double load)
{
  for (const twin::RecalibratedValue &value : recalibration.values) {
    Parameter *spring = value.identified ? spring_of(chain, value.name) : nullptr;
    if (!spring)
      continue;
    Parameter &K = *spring;
    K.value *= std::exp(value.change);
    K.error_estimate = value.sd;
    K.source         = Source::measured;
    K.method         = fmt::format("re-calibration on {:.0f} s of the running mill", recalibration.seconds);
    K.at             = at_force(load);
  }
  return chain;
}

double recalibrated(double damping, const twin::Recalibration &recalibration)
{
  for (const twin::RecalibratedValue &value : recalibration.values)
    if (value.identified && twin::moves(value) == twin::Moves::ratios)
      damping *= std::exp(value.change);
  return damping;
}

std::string recalibration_comment(const Proposal &p)
{
  std::string text = "# Re-calibrated on the running mill.  " + p.reason + "\n";
  text += fmt::format("# Data: {} to {}, {:.0f} s at {}; misfit {:.3f} before, {:.3f} after.\n", utc_text(p.from),
                      utc_text(p.to), p.recalibration.seconds, force_text(p.recalibration.load),
                      p.recalibration.misfit_before, p.recalibration.misfit_after);
  std::string kept;
  for (const twin::RecalibratedValue &value : p.recalibration.values)
    if (value.identified)
      text += fmt::format("# {}: {:+.2f} %, standard deviation {:.2f} %\n", value.name,
                          100 * std::expm1(value.change), 100 * value.sd);
    else
      kept += (kept.empty() ? "" : ", ") + value.name;
  if (!kept.empty())
    text += "# not identified by these data, as before: " + kept + "\n";
  return text;
}

Case with_damping(Case origin, const double damping)
{
  if (std::holds_alternative<ChatterCase>(origin.spec))
    origin.spec = Lumped{};
  if (auto *four = std::get_if<FourHigh>(&origin.spec))
    four->dynamics.modal_damping = damping;
  else if (auto *lumped = std::get_if<Lumped>(&origin.spec))
    lumped->dynamics.modal_damping = damping;
  return origin;
}

std::string calibrated_case(const Proposal &p, const Case &origin, const std::string &directory)
{
  std::string text = recalibration_comment(p);
  if (std::holds_alternative<ChatterCase>(origin.spec))
    text += "# For a chatter case: [stand] from = \"this file\" in place of masses, stiffnesses and dampings.\n";
  return text + lumped_model_toml(p.chain, with_damping(origin, p.damping), directory);
}

void Proposals::twin_changed()
{
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].state == ProposalState::open) {
      list[i].state = ProposalState::out_of_date;
      changed.push_back(i);
    }
}

const Proposal &Proposals::add(Proposal proposal)
{
  twin_changed();
  proposal.id = list.empty() ? 1 : list.back().id + 1;
  list.push_back(std::move(proposal));
  changed.push_back(list.size() - 1);
  return list.back();
}

const Proposal *Proposals::find(const std::int64_t id) const
{
  const auto proposal = std::find_if(list.begin(), list.end(), [&](const Proposal &p) { return p.id == id; });
  return proposal == list.end() ? nullptr : &*proposal;
}

Proposal *Proposals::known(const std::int64_t id)
{
  return const_cast<Proposal *>(find(id));
}

void Proposals::resume(std::vector<Proposal> stored)
{
  list = std::move(stored);
  changed.resize(list.size());
  std::iota(changed.begin(), changed.end(), std::size_t(0));
}

const std::vector<Proposal> &Proposals::all() const
{
  return list;
}

std::optional<Proposal>
Proposals::adopt(const std::int64_t id, const double utc, const std::string &folder,
                 const std::function<std::string(const Proposal &, const std::string &folder)> &text)
{
  Proposal *open = known(id);
  if (!open || open->state != ProposalState::open)
    return {};
  Proposal adopted = *open;
  adopted.file     = free_name(folder, utc);
  write_atomically(adopted.file, text(adopted, folder));
  const std::string line = fmt::format("{} proposal {} adopted: {}; {}\n", utc_text(utc), id,
                                       std::filesystem::path(adopted.file).filename().string(), adopted.reason);
  try {
    append_line(folder + "/adopted.log", line);
  } catch (...) {  // a case that was not adopted would be taken for one
    std::error_code ignored;
    std::filesystem::remove(adopted.file, ignored);
    throw;
  }
  adopted.state = ProposalState::adopted;
  *open         = adopted;
  changed.push_back(std::size_t(open - list.data()));
  return adopted;
}

std::vector<PageProposal> Proposals::news()
{
  std::vector<PageProposal> pages;
  for (const std::size_t i : std::exchange(changed, {}))
    pages.push_back(page_proposal(list[i]));
  return pages;
}

PageProposal page_proposal(const Proposal &p)
{
  PageProposal page;
  page.id    = p.id;
  page.utc   = p.utc;
  page.state = word_of(p.state);
  page.file  = p.file.empty() ? "" : std::filesystem::path(p.file).filename().string();
  page.text  = fmt::format("{} On {:.0f} s from {} to {} the misfit falls from {:.3f} to {:.3f}.", p.reason,
                           p.recalibration.seconds, utc_text(p.from), utc_text(p.to), p.recalibration.misfit_before,
                           p.recalibration.misfit_after);
  if (p.state == ProposalState::open)
    page.text += " Nothing is changed until it is adopted.";
  for (const twin::RecalibratedValue &value : p.recalibration.values) {
    ProposedValue row;
    row.key                 = twin::moves(value) == twin::Moves::ratios ? "damping" : value.name;
    row.unit                = twin::moves(value) == twin::Moves::ratios ? "-" : "N/m";
    row.identified          = value.identified;
    const Parameter *before = spring_of(p.before, value.name), *after = spring_of(p.chain, value.name);
    row.from = before ? before->value : p.damping_before;
    row.to   = after ? after->value : p.damping;
    if (value.identified) {
      row.low  = row.to * std::exp(-1.96 * value.sd);
      row.high = row.to * std::exp(1.96 * value.sd);
    }
    page.values.push_back(row);
  }
  return page;
}
}  // namespace mill::live
