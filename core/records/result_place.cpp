#include "core/records/result_place.h"
#include "core/base/digits.h"
#include "core/model/dynamics_settings.h"
#include "core/records/bite_model.h"
#include "core/records/chain_number.h"
#include "core/records/contact_name.h"
#include "core/records/result_names.h"
#include "core/records/result_row.h"
#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace mill {
namespace {
using Words = std::vector<std::pair<std::string, std::string>>;

// Words of docs/output.md for a number, for Kzc1 .. Kzc4, and for the contacts of both halves.
constexpr const char *any_number = "N", *any_seat = "KzcN", *both_contacts = "upper/lower";

bool any_part(const std::string &part)
{
  return !part.empty();
}

bool number_or_N(const std::string &part)
{
  return part == any_number || (!part.empty() && is_digits(part));
}

std::string plain_part(const std::string &part)
{
  return part;
}

std::string with_spaces(std::string part)
{
  std::replace(part.begin(), part.end(), '_', ' ');
  return part;
}

// Of one of these words, and of no other.
ResultPlace place_of_words(const char *name, Words words)
{
  ResultPlace place{name, {}, {}, {}};
  for (const auto &one : words)
    place.on_page.push_back(one.first);
  const auto known = [words](const std::string &part) {
    return std::find_if(words.begin(), words.end(), [&](const auto &one) { return one.first == part; });
  };
  place.takes = [words, known](const std::string &part) {
    return std::any_of(words.begin(), words.end(), [&](const auto &one) { return one.first == part; });
  };
  place.words = [words](const std::string &part) {
    const auto one = std::find_if(words.begin(), words.end(), [&](const auto &w) { return w.first == part; });
    return one == words.end() ? part : one->second;
  };
  return place;
}

// Of any name; these words have a meaning.
ResultPlace place_of_names(const char *name, std::vector<std::string> on_page, Words words = {},
                           std::string (*otherwise)(std::string) = nullptr)
{
  return {name, std::move(on_page), any_part, [words, otherwise](const std::string &part) {
            const auto one =
                std::find_if(words.begin(), words.end(), [&](const auto &w) { return w.first == part; });
            return one != words.end() ? one->second : otherwise ? otherwise(part) : part;
          }};
}

std::string words_of_seat(const std::string &part)
{
  const auto number = choice_named<ChainNumber>(part);
  if (!number)
    return part == family::bearing ? "the bearing at its load" : "one bearing of a roll";
  switch (*number) {
  case ChainNumber::Kzc1:
    return "one bearing of the upper backup roll";
  case ChainNumber::Kzc2:
    return "one bearing of the upper work roll";
  case ChainNumber::Kzc3:
    return "one bearing of the lower work roll";
  default:
    return "one bearing of the lower backup roll";
  }
}

std::string words_of_contact(const std::string &part)
{
  if (is_contact(part, ContactName::upper))
    return "upper contact (K3)";
  return is_contact(part, ContactName::lower) ? "lower contact (K5)" : "upper or lower contact (K3, K5)";
}

// "lower_work_roll_chock" -> "lower work-roll chock"
std::string words_of_body(std::string part)
{
  static const Words chocks{{"upper_backup_chock", "upper backup-roll chock"},
                            {"lower_backup_chock", "lower backup-roll chock"},
                            {"upper_work_roll_chock", "upper work-roll chock"},
                            {"lower_work_roll_chock", "lower work-roll chock"}};
  for (const auto &[name, words] : chocks)
    if (part == name)
      return words;
  return with_spaces(std::move(part));
}

std::string words_of_force(std::string part)
{
  return part == family::bite ? "force in the bite" : "force on the " + words_of_body(std::move(part));
}

std::vector<ResultPlace> places_of_stand()
{
  const std::string K3 = word_of(ChainNumber::K3), K5 = word_of(ChainNumber::K5);
  return {
      place_of_names("pass", {"PASS"}),
      place_of_names("passes", {"PASS"}),
      place_of_words("open", {{family::open, "open stand, without the strip between the work rolls"}}),
      place_of_words("roll_contact",
                     {{K3, "upper backup roll on upper work roll"}, {K5, "lower work roll on lower backup roll"}}),
      {"contact",
       {both_contacts},
       [](const std::string &part) { return is_of_stand(part) || part == both_contacts; },
       words_of_contact},
      {"bearing_spring",
       {family::bearing, any_seat},
       [](const std::string &part) { return part == family::bearing || part == any_seat || is_bearing(part); },
       words_of_seat},
      {"seat",
       {any_seat},
       [](const std::string &part) { return part == any_seat || is_bearing(part); },
       words_of_seat},
      place_of_names("bearing", {"BEARING"}),
      place_of_words("stand_model",
                     {{word_of(StandModelKind::beam), "stand with rolls as beams"},
                      {word_of(StandModelKind::craig_bampton), "stand with rolls as reduced finite elements"}}),
      {"n", {any_number}, number_or_N, plain_part},
      place_of_names("mode", {"MODE"}, {}, with_spaces),
      place_of_names("place", {"PLACE"}, {}, words_of_body),
      place_of_names("excited", {"EXCITED"}, {}, words_of_force),
      place_of_words("work_roll",
                     {{"upper_work_roll", "upper work roll"}, {"lower_work_roll", "lower work roll"}}),
      place_of_names("body", {"ROLL"}, {}, with_spaces),
      place_of_names("spring", {"SPRING"}),
      place_of_names("frame_part",
                     {"oil_column", "piston", "load_cell", "upper_post", "upper_beam", "lower_post", "lower_beam",
                      "upper_packing", "cylinder_body", "upper_chock", "lower_chock", "lower_packing"},
                     {}, with_spaces),
      place_of_names("housing_part", {"upper_post", "upper_beam", "lower_post", "lower_beam"}, {}, with_spaces)};
}

std::vector<ResultPlace> places_of_bite()
{
  return {place_of_names("bite_model", {"MODEL"},
                         {{word_of(BiteModel::fe), "finite elements"},
                          {word_of(BiteModel::karman), "K\u00e1rm\u00e1n's slab"},
                          {word_of(BiteModel::karman_rigid), "K\u00e1rm\u00e1n's slab, rigid roll"},
                          {word_of(BiteModel::karman_elastic_arc), "K\u00e1rm\u00e1n's slab, free arc"},
                          {word_of(BiteModel::orowan), "Orowan"},
                          {word_of(BiteModel::bland_ford), "Bland and Ford"},
                          {word_of(BiteModel::hu_ehmann), "Hu and Ehmann"},
                          {word_of(BiteModel::sims), "Sims"}}),
          place_of_words("strip_speed",
                         {{"P", "speed of the strip at the entry"}, {"Q", "speed of the strip at the exit"}}),
          place_of_names("number", {"friction", "friction_factor", "flow_stress_factor", "CONSTANT"},
                         {{"friction", "friction in the bite"},
                          {"friction_factor", "factor on the friction"},
                          {"flow_stress_factor", "factor on the flow stress"}}),
          place_of_names("unknown", {"friction", "flow_stress"}, {}, with_spaces),
          place_of_names("quantity", {}),
          place_of_names("measure", {"force", "slip", "torque"},
                         {{"force", "roll force"}, {"slip", "forward slip"}, {"torque", "torque of one roll"}})};
}

std::vector<ResultPlace> places_of_stacks()
{
  ResultPlace key = place_of_names("key", {any_key});
  key.takes_rest  = true;
  return {place_of_names("roll", {"ROLL"}),
          place_of_names("rolls", {"CONTACT"}),
          place_of_names("pair", {"PAIR"}),
          place_of_words("axis", {{"x", "x"}, {"y", "y"}}),
          place_of_names("variant", {"VARIANT"}),
          place_of_names("scheme", {"sequential", "consistent", "frozen-friction"}),
          place_of_names("structure", {"MODEL"}),
          place_of_words("profile", {{"crown", "crown"}, {"edge_drop", "edge drop"}}),
          place_of_names("channel", {"CHANNEL"}),
          place_of_names("band", {"BAND"}),
          key};
}
}  // namespace

const std::vector<ResultPlace> &result_places()
{
  static const std::vector<ResultPlace> all = [] {
    std::vector<ResultPlace> places = places_of_stand();
    for (const auto &more : {places_of_bite(), places_of_stacks()})
      places.insert(places.end(), more.begin(), more.end());
    return places;
  }();
  return all;
}

const ResultPlace &result_place(const std::string &name)
{
  for (const ResultPlace &place : result_places())
    if (name == place.name)
      return place;
  throw std::logic_error("no place of results has the name " + name);
}

bool is_any_name(const std::string &part)
{
  if (part.empty() || !std::all_of(part.begin(), part.end(), [](const char c) { return c >= 'A' && c <= 'Z'; }))
    return false;
  for (const ResultPlace &place : result_places())
    if (part.size() > 1 && std::find(place.on_page.begin(), place.on_page.end(), part) != place.on_page.end())
      return true;
  return false;
}
}  // namespace mill
