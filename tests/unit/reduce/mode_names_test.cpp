// Names of modes: the same rules for six masses and for beams.
#include "reduce/chain/line_contact.h"
#include "reduce/stand/beam_stand.h"
#include "reduce/stand/mode_names.h"
#include "reduce/stand/six_masses.h"
#include "tests/support/beam_demo.h"
#include "tests/support/near.h"
#include <algorithm>
#include <set>

using namespace mill;
using namespace mill::reduce;

namespace {
/// A stand of a cold tandem mill: slender work rolls, heavy backup rolls, stiff frame.
FourHigh cold_tandem()
{
  FourHigh s                   = demo_drawing();
  s.work_roll.barrel_diameter  = 0.585;
  s.work_roll.barrel_length    = 1.7;
  s.work_roll.neck_diameter    = 0.38;
  s.work_roll.bearing_span     = 2.5;
  s.work_roll.chock_mass_upper = s.work_roll.chock_mass_lower = 1500;
  s.backup_roll.barrel_diameter                               = 1.5;
  s.backup_roll.barrel_length                                 = 1.7;
  s.backup_roll.bearing_span                                  = 2.75;
  s.frame.upper_beam_stiffness                                = 9e9;
  s.frame.lower_beam_stiffness                                = 1.2e10;
  s.strip.width                                               = 1.2;
  return s;
}

/// A plate stand: everything larger and stiffer.
FourHigh plate()
{
  FourHigh s                   = demo_drawing();
  s.work_roll.barrel_diameter  = 1.05;
  s.work_roll.barrel_length    = 3.8;
  s.work_roll.neck_diameter    = 0.7;
  s.work_roll.neck_length      = 1;
  s.work_roll.bearing_span     = 5;
  s.work_roll.bearing_mass     = 900;
  s.work_roll.chock_mass_upper = s.work_roll.chock_mass_lower = 9000;
  s.backup_roll.barrel_diameter                               = 2;
  s.backup_roll.barrel_length                                 = 3.8;
  s.backup_roll.neck_diameter                                 = 1.4;
  s.backup_roll.neck_length                                   = 1.4;
  s.backup_roll.bearing_span                                  = 5.2;
  s.backup_roll.chock_mass_upper = s.backup_roll.chock_mass_lower = 30000;
  Frame &f                                                        = s.frame;
  for (double *K : {&f.upper_post_stiffness, &f.upper_beam_stiffness, &f.piston_stiffness, &f.oil_column_stiffness,
                    &f.cylinder_body_stiffness, &f.upper_chock_stiffness, &f.lower_chock_stiffness,
                    &f.lower_post_stiffness, &f.lower_beam_stiffness})
    *K *= 2.5;
  for (double *m : {&f.upper_post_mass, &f.upper_beam_mass, &f.lower_post_mass, &f.lower_beam_mass})
    *m *= 4;
  s.strip.width = 2.5;
  return s;
}

struct Models {
  StandWithModes six, beams;
};

Models models_of(const FourHigh &drawing, const double load, const double K4)
{
  LumpedStand chain = demo_chain(drawing, K4);
  ChainInputs in;
  const auto spring = [](const double value) {
    Parameter p;
    p.value = value;
    return p;
  };
  const double K3 = line_contact({drawing.work_roll.barrel_diameter, drawing.backup_roll.barrel_diameter,
                                  drawing.work_roll.barrel_length, drawing.steel},
                                 load)
                        .tangent;
  in.K3 = in.K5 = spring(K3);
  in.K4         = spring(K4);
  in.K_Zy_upper = in.K_Zy_lower = spring(1.023e11);
  in.Kzc                        = {spring(5.1e10), spring(1.9e10), spring(1.9e10), spring(5.1e10)};
  chain                         = lumped_stand(drawing, in);
  StandSprings springs          = stand_springs(drawing, chain, true);
  springs.K4                    = K4;
  Models m{{chain_stand(chain.model), {}}, {beam_stand(drawing, springs, 12), {}}};
  m.six.modes   = stand_modes(m.six.model);
  m.beams.modes = stand_modes(m.beams.model, 1500);
  return m;
}

int count(const std::vector<ModeName> &names, const std::string &key)
{
  return int(std::count_if(names.begin(), names.end(), [&](const ModeName &n) { return n.key == key; }));
}

struct StandCase {
  const char *name;
  FourHigh drawing;
  double load, K4;
};
const std::vector<StandCase> &cases()
{
  static const std::vector<StandCase> all{{"demo", demo_drawing(), 976.2e3, 0},
                                          {"demo, strip kept", demo_drawing(), 976.2e3, 1e9},
                                          {"cold tandem", cold_tandem(), 9e6, 0},
                                          {"cold tandem with strip", cold_tandem(), 9e6, 4e9},
                                          {"plate", plate(), 3e7, 0},
                                          {"plate with strip", plate(), 3e7, 2e9}};
  return all;
}
}  // namespace

TEST(ModeNames, OneGapModeOfTheFirstKindInEveryModelAndTheOneWithTheLargestShare)
{
  for (const StandCase &c : cases()) {
    const Models m = models_of(c.drawing, c.load, c.K4);
    for (const StandWithModes *s : {&m.six, &m.beams}) {
      const auto names = mode_names(*s);
      SCOPED_TRACE(c.name + (", " + s->model.name));
      EXPECT_EQ(count(names, "gap_first_kind"), 1);
      double largest = 0, leads = 0;
      for (const ModeName &mode : names) {
        if (mode.kind == GapKind::first)
          largest = std::max(largest, mode.gap_share);
        if (mode.key == "gap_first_kind")
          leads = mode.gap_share;
      }
      EXPECT_EQ(leads, largest);
      EXPECT_GE(largest, least_share_of_gap_mode);
    }
  }
}

TEST(ModeNames, AreKeysOfResultsAndSayWhy)
{
  for (const StandCase &c : cases()) {
    const Models m = models_of(c.drawing, c.load, c.K4);
    std::set<std::string> keys;
    for (const ModeName &mode : mode_names(m.beams)) {
      EXPECT_EQ(mode.name.find("mixed"), std::string::npos);
      EXPECT_NE(mode.decided.find(" % of the static compliance of the gap"), std::string::npos) << mode.name;
      if (mode.key.empty()) {
        EXPECT_LT(mode.gap_share, least_share_of_gap_mode) << mode.name;
        continue;
      }
      EXPECT_TRUE(keys.insert(mode.key).second) << mode.key << " twice in " << c.name;
      EXPECT_EQ(mode.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789"), std::string::npos)
          << mode.key;
      if (mode.kind == GapKind::none) {
        EXPECT_EQ(mode.name.find("order 4"), std::string::npos) << mode.name;
      }
    }
  }
}

// A mode whose energy lies in two parts has the name of the larger one, however near the other is.
TEST(ModeNames, TheLargerPartDecidesWhereTheGapSeesNothing)
{
  Models m    = models_of(demo_drawing(), 976.2e3, 0);
  auto &modes = m.six.modes;
  modes.shape.col(0).segment(2, 2).setZero();  // the work rolls, and with them the gap, stand still
  modes.kinetic.col(0) << 0.52, 0, 0, 0, 0, 0.48;
  const ModeName frame = mode_names(m.six)[0];
  EXPECT_EQ(frame.key, "frame_upper");
  EXPECT_EQ(frame.decided, "upper frame 52 % of the kinetic energy; 0.0 % of the static compliance of the gap");
}

TEST(ModeNames, ListWhatTheGapOrASensorSees)
{
  Models m = models_of(demo_drawing(), 976.2e3, 0);
  for (const ModeName &mode : mode_names(m.beams))
    EXPECT_TRUE(mode.listed || mode.gap_share < least_share_listed) << mode.name;
  const auto all = mode_names(m.beams);
  EXPECT_GT(std::count_if(all.begin(), all.end(), [](const ModeName &mode) { return !mode.listed; }), 0);
  m.six.modes.shape.col(0) *= 1e-6;  // neither the gap nor a place moves
  EXPECT_FALSE(mode_names(m.six)[0].listed);
}

namespace {
std::vector<std::vector<ModeName>> common(const Models &m)
{
  return common_names({&m.beams, &m.six}, {{0, 1, mac_with_chain(m.beams, m.six)}});
}
}  // namespace

TEST(CommonNames, OneForEachModeThatTwoModelsShare)
{
  int shared = 0;
  for (const StandCase &c : cases()) {
    const Models m   = models_of(c.drawing, c.load, c.K4);
    const auto names = common(m);
    const auto mac   = mac_with_chain(m.beams, m.six);
    for (Eigen::Index i = 0; i < mac.rows(); ++i)
      for (Eigen::Index j = 0; j < mac.cols(); ++j) {
        const ModeName &beam = names[0][std::size_t(i)], &six = names[1][std::size_t(j)];
        const double ratio = beam.gap_share / six.gap_share;
        if (mac(i, j) <= same_mode || beam.key.empty())
          continue;
        if (ratio <= same_share && ratio >= 1 / same_share) {
          ++shared;
          EXPECT_EQ(beam.name, six.name) << c.name;
        } else
          EXPECT_NE(beam.key, six.key) << c.name << ": shares of the gap " << beam.gap_share << " and "
                                       << six.gap_share;
      }
    for (const auto &of_model : names) {
      std::set<std::string> keys;
      for (const ModeName &mode : of_model)
        EXPECT_TRUE(mode.key.empty() || keys.insert(mode.key).second) << mode.key << " twice in " << c.name;
    }
  }
  EXPECT_GE(shared, 12);
}

// The name follows the shape; what the shares of the other model say is given in addition.
TEST(CommonNames, TheDetailedModelGivesThemAndTheOtherSaysWhatItSees)
{
  Models m                = models_of(demo_drawing(), 976.2e3, 0);
  const auto mac          = mac_with_chain(m.beams, m.six);
  const auto shared_names = common(m);
  Eigen::Index i = 0, j = 0;
  double best = 0;
  for (Eigen::Index a = 0; a < mac.rows(); ++a)
    for (Eigen::Index b = 0; b < mac.cols(); ++b)
      if (shared_names[0][std::size_t(a)].name == shared_names[1][std::size_t(b)].name &&
          shared_names[0][std::size_t(a)].kind != GapKind::none && mac(a, b) > best)
        best = mac(a, b), i = a, j = b;
  ASSERT_GT(best, same_mode);
  const std::string before = shared_names[0][std::size_t(i)].name;
  m.six.modes.shape(m.six.modes.shape.rows() - 2, j) *= -1;  // the backup rolls turn round under the same likeness
  m.six.modes.shape(1, j) *= -1;
  const ModeName six = common_names({&m.beams, &m.six}, {{0, 1, mac}})[1][std::size_t(j)];
  EXPECT_EQ(six.name, before);
  EXPECT_NE(six.own_name, "");
  EXPECT_NE(six.decided.find("mode " + std::to_string(i + 1) + " of beam: work roll "), std::string::npos)
      << six.decided;
  EXPECT_NE(six.decided.find("; by its own shares " + six.own_name), std::string::npos) << six.decided;
}

// A chock that a beam carries rigidly is named as one that stands on its bearing is.
TEST(ModeNames, NamesACarriedChockAsAChock)
{
  FourHigh drawing                   = demo_drawing();
  drawing.work_roll.chock_mass_upper = drawing.work_roll.chock_mass_lower = 1200;
  const LumpedStand chain                                                 = demo_chain(drawing, 0);
  const StandModel carried = beam_stand(drawing, stand_springs(drawing, chain), 12);
  const auto &masses       = carried.carried;
  ASSERT_EQ(masses.size(), 2u);
  EXPECT_EQ(masses[0].name, "upper work-roll chock");
  EXPECT_EQ(masses[0].carrier, "upper work roll");
  EXPECT_EQ(masses[0].mass, 2 * drawing.work_roll.chock_mass_upper);
  StandWithModes with{carried, stand_modes(carried, 1500)};
  StandWithModes without = with;
  without.model.carried.clear();
  const auto is_chock = [](const ModeName &n) {
    return n.key.rfind("chock_", 0) == 0 && n.key.find("work_roll") != std::string::npos;
  };
  const auto named = mode_names(with), blind = mode_names(without);
  EXPECT_GE(std::count_if(named.begin(), named.end(), is_chock), 2) << "one for each work roll at least";
  EXPECT_EQ(std::count_if(blind.begin(), blind.end(), is_chock), 0)
      << "counted with the roll they belong to no mode";
}
