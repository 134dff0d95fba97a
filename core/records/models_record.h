#pragma once
#include "core/base/each_member.h"
#include "core/model/material.h"
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

// Models of one stand and what they say about each other: curves/models.json.  reduce/ and app/ fill the record,
// report/ draws it.  A number that is not known is NaN.
namespace mill {
struct ModelMode {
  double frequency = not_given;        ///< Hz
  std::string name;                    ///< "gap mode, first kind (third octave)"; empty: not known
  std::string own_name;                ///< by its own shares, where `name` is another model's; empty: the same
  std::string decided;                 ///< the numbers that gave it that name
  double gap_share      = not_given;   ///< 0 .. 1, share of the static compliance of the gap
  bool listed           = true;        ///< the gap or a sensor sees it
  double error_estimate = not_given;   ///< relative, of the frequency
  double in_chain       = not_given;   ///< 0 .. 1, share of its motion that six masses can follow
  Eigen::VectorXd points;              ///< (points) relative displacement, up, largest of the mode = 1
  Eigen::VectorXd kinetic;             ///< (parts) share of the kinetic energy
  Eigen::VectorXd strain;              ///< (springs) share of the strain energy
  std::vector<Eigen::VectorXd> lines;  ///< one per line, relative displacement of each station
};

/// The axis of a roll from mid-length outwards; the other half is its mirror image.
struct ModelLine {
  std::string name;   ///< "upper work roll"
  Eigen::VectorXd z;  ///< (k) m
};

struct ComparedModel {
  std::string name;   ///< "six-mass", "beam", "craig-bampton"
  std::string title;  ///< "six masses"
  int unknowns = 0;
  std::string source;
  std::vector<std::string> points, parts, springs;
  std::vector<ModelLine> lines;
  std::vector<ModelMode> modes;
};

/// The mode of another model that looks most like one of the six masses.
struct Partner {
  int mode         = 0;          ///< from 1
  double frequency = not_given;  ///< Hz
  double mac       = not_given;  ///< 0 .. 1, how alike the shapes are
};

struct ModePartners {
  int mode        = 0;                     ///< of the six masses, from 1
  double six_mass = not_given;             ///< Hz
  std::map<std::string, Partner> partner;  ///< by name of the other model; absent: none
};

struct MacTable {
  std::string rows, columns;                        ///< names of two models
  Eigen::VectorXd row_frequency, column_frequency;  ///< Hz
  Eigen::MatrixXd values;                           ///< (rows, columns) 0 .. 1
};

/// How well a number of masses shows the modes of a stand below the frequency limit.
struct MassesRow {
  int masses = 0;
  std::string added;            ///< point added in this step; for the first rows what they are
  std::vector<std::string> at;  ///< points that carry the masses
  double worst_error    = 0;    ///< -, of the frequencies of the modes that are shown
  int right             = 0;    ///< modes shown with an error below 5 %
  int modes_below_limit = 0;
  std::vector<double> missing;  ///< Hz, modes that have no counterpart (assurance below 0.5)
};

/// How the frequencies of the assembled stand settle with the modes that its parts keep.
struct KeptModes {
  std::vector<int> kept;      ///< (s) fixed-interface modes of each part
  Eigen::VectorXd frequency;  ///< (m) Hz, with all of them
  Eigen::MatrixXd error;      ///< (s, m) -, relative to those
};

/// One part behind an equivalent mass.
struct PartMass {
  std::string name;       ///< "barrel", "necks", "bearings", "chocks", ...
  double mass       = 0;  ///< kg, real mass, both sides
  double equivalent = 0;  ///< kg, what it adds to the equivalent mass
};

/// One of M1..M6 as the sum of its parts: sum of `equivalent` = value.
struct MassBreakdown {
  std::string mass;   ///< "M2"
  std::string route;  ///< "chain" | "finite elements"
  std::vector<PartMass> parts;
  double value = 0;  ///< kg
};

struct MassRoutes {
  std::string mass;                ///< "M2"
  double chain       = not_given;  ///< kg, closed form
  double fe_integral = not_given;  ///< kg, the same integrals over the finite-element axis
  double fe_solid    = not_given;  ///< kg, all points of the finite elements
  double published   = not_given;  ///< kg
};

struct ModelsRecord {
  double frequency_limit = not_given;  ///< Hz, up to which the modes are to be right
  std::string at;                      ///< load of the tangents, "976.2 kN"
  std::string driven;                  ///< name of the model that the responses of this run come from
  std::vector<std::string> answer, warnings;
  std::vector<ComparedModel> models;
  std::vector<ModePartners> pairs;
  MacTable mac;
  std::vector<MassesRow> masses_needed;
  KeptModes kept_modes;
  std::vector<MassBreakdown> breakdown;
  std::vector<MassRoutes> routes;
};

template <class Io, class R, if_record<R, ModelMode> = 0> void each_member(Io &&io, R &record)
{
  auto &[frequency, name, own_name, decided, gap_share, listed, error_estimate, in_chain, points, kinetic, strain,
         lines] = record;
  io("frequency", frequency);
  io("name", name);
  io("own_name", own_name);
  io("decided", decided);
  io("gap_share", gap_share);
  io("listed", listed);
  io("error_estimate", error_estimate);
  io("in_chain", in_chain);
  io("points", points);
  io("kinetic", kinetic);
  io("strain", strain);
  io("lines", lines);
}

template <class Io, class R, if_record<R, ModelLine> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, z] = record;
  io("name", name);
  io("z", z);
}

template <class Io, class R, if_record<R, ComparedModel> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, title, unknowns, source, points, parts, springs, lines, modes] = record;
  io("name", name);
  io("title", title);
  io("unknowns", unknowns);
  io("source", source);
  io("points", points);
  io("parts", parts);
  io("springs", springs);
  io("lines", lines);
  io("modes", modes);
}

template <class Io, class R, if_record<R, Partner> = 0> void each_member(Io &&io, R &record)
{
  auto &[mode, frequency, mac] = record;
  io("mode", mode);
  io("frequency", frequency);
  io("mac", mac);
}

template <class Io, class R, if_record<R, ModePartners> = 0> void each_member(Io &&io, R &record)
{
  auto &[mode, six_mass, partner] = record;
  io("mode", mode);
  io("six_mass", six_mass);
  io("partners", partner);
}

template <class Io, class R, if_record<R, MacTable> = 0> void each_member(Io &&io, R &record)
{
  auto &[rows, columns, row_frequency, column_frequency, values] = record;
  io("rows", rows);
  io("columns", columns);
  io("row_frequency", row_frequency);
  io("column_frequency", column_frequency);
  io("values", values);
}

template <class Io, class R, if_record<R, MassesRow> = 0> void each_member(Io &&io, R &record)
{
  auto &[masses, added, at, worst_error, right, modes_below_limit, missing] = record;
  io("masses", masses);
  io("added", added);
  io("at", at);
  io("worst_error", worst_error);
  io("right", right);
  io("modes_below_limit", modes_below_limit);
  io("missing", missing);
}

template <class Io, class R, if_record<R, KeptModes> = 0> void each_member(Io &&io, R &record)
{
  auto &[kept, frequency, error] = record;
  io("kept", kept);
  io("frequency", frequency);
  io("error", error);
}

template <class Io, class R, if_record<R, PartMass> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, mass, equivalent] = record;
  io("name", name);
  io("mass", mass);
  io("equivalent", equivalent);
}

template <class Io, class R, if_record<R, MassBreakdown> = 0> void each_member(Io &&io, R &record)
{
  auto &[mass, route, parts, value] = record;
  io("mass", mass);
  io("route", route);
  io("parts", parts);
  io("value", value);
}

template <class Io, class R, if_record<R, MassRoutes> = 0> void each_member(Io &&io, R &record)
{
  auto &[mass, chain, fe_integral, fe_solid, published] = record;
  io("mass", mass);
  io("chain", chain);
  io("fe_integral", fe_integral);
  io("fe_solid", fe_solid);
  io("published", published);
}

template <class Io, class R, if_record<R, ModelsRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[frequency_limit, at, driven, answer, warnings, models, pairs, mac, masses_needed, kept_modes, breakdown,
         routes] = record;
  io("frequency_limit", frequency_limit);
  io("at", at);
  io("driven", driven);
  io("answer", answer);
  io("warnings", warnings);
  io("models", models);
  io("pairs", pairs);
  io("mac", mac);
  io("masses_needed", masses_needed);
  io("kept_modes", kept_modes);
  io("breakdown", breakdown);
  io("routes", routes);
}
}  // namespace mill
