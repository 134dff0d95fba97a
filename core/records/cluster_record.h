#pragma once
#include "core/base/each_member.h"
#include "core/model/material.h"
#include <Eigen/Core>
#include <string>
#include <vector>

// A planar stack of rolls as computed by a run: curves/cluster.json.  cluster/ and app/ fill the record, report/
// draws it. SI; a number that is not known is NaN.
namespace mill {
struct ClusterRollRecord {
  std::string name;
  double x = 0, y = 0;  ///< m, unloaded axis
  double radius = 0;    ///< m
  double mass   = 0;    ///< kg
};

struct ClusterContactRecord {
  std::string name;  ///< "W-I"
  int a = 0, b = 0;  ///< rolls
  std::string law;   ///< "power", "computed"
};

struct ClusterSupportRecord {
  std::string name, type;
  int roll    = 0;
  bool fitted = false;
};

struct ClusterShare {
  std::string name;
  double value = 0;  ///< -
};

struct ClusterModeRecord {
  double frequency = not_given;       ///< Hz; negative: grows
  std::string label;                  ///< "E y on E"
  std::string identity;               ///< name of the [[mode]] that it is; empty: none
  Eigen::VectorXd shape;              ///< x and y of every roll, largest 1
  std::vector<ClusterShare> elastic;  ///< contacts and supports
  std::vector<ClusterShare> kinetic;  ///< rolls and directions
};

/// One contact or support under one pass.
struct ClusterLoadRecord {
  std::string name;
  double force    = not_given;  ///< N
  double approach = not_given;  ///< m
  double tangent  = not_given;  ///< N/m
  double secant   = not_given;  ///< N/m
};

struct ClusterHistoryRecord {
  double force     = not_given;                 ///< N, amplitude of the drive
  double frequency = not_given;                 ///< Hz
  std::vector<ClusterShare> nonlinear, linear;  ///< m/s, velocity amplitude of every roll and direction
  double difference  = not_given;               ///< -, of the roll at the strip
  double least_force = not_given;               ///< -, smallest force of a contact over its force at rest
  std::string least_contact;
  int events           = 0;          ///< contacts that opened or closed
  double first_opening = not_given;  ///< s
  std::string verdict;
};

struct ClusterPassRecord {
  std::string name;
  double force = not_given;      ///< N
  std::string force_source;      ///< "given"
  Eigen::VectorXd displacement;  ///< m, x and y of every roll
  std::vector<ClusterLoadRecord> contacts, supports;
  std::vector<ClusterModeRecord> modes;
  double least_root      = not_given;  ///< 1/s2
  double buckling_factor = not_given;  ///< -, on the force; NaN: beyond the range searched
  std::string buckling_motion;
  std::vector<ClusterShare> least_guides;  ///< N/m, of every guide; NaN: none helps
  double leaving_force = not_given;        ///< N, horizontal on the roll at the strip
  std::string leaving_contact;
  std::vector<ClusterHistoryRecord> histories;
};

/// A [[mode]] with a frequency, and the computed one of the first pass.
struct ClusterPublished {
  std::string name, shape;
  double frequency = not_given;  ///< Hz
};

struct ClusterFitNumber {
  std::string key;
  double start = not_given, value = not_given, interval = not_given;  ///< SI
};

struct ClusterFitFrequency {
  std::string mode;
  double wanted = not_given, computed = not_given;  ///< Hz
  bool fitted = false;
};

struct ClusterFitRecord {
  std::string variant, pass, set;
  std::vector<ClusterFitNumber> numbers;
  std::vector<ClusterFitFrequency> frequencies;
  Eigen::MatrixXd correlation;
  double rms_fitted = not_given, rms_predicted = not_given;  ///< -
  bool converged = false;
  std::string undetermined, refused;
};

struct ClusterRecord {
  std::vector<ClusterRollRecord> rolls;
  std::vector<ClusterContactRecord> contacts;
  std::vector<ClusterSupportRecord> supports;
  std::string strip;  ///< roll at the strip
  std::vector<ClusterPassRecord> passes;
  std::vector<ClusterPublished> published;
  std::vector<ClusterFitRecord> fits;
};

template <class Io, class R, if_record<R, ClusterRollRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, x, y, radius, mass] = record;
  io("name", name);
  io("x", x);
  io("y", y);
  io("radius", radius);
  io("mass", mass);
}

template <class Io, class R, if_record<R, ClusterContactRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, a, b, law] = record;
  io("name", name);
  io("a", a);
  io("b", b);
  io("law", law);
}

template <class Io, class R, if_record<R, ClusterSupportRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, type, roll, fitted] = record;
  io("name", name);
  io("type", type);
  io("roll", roll);
  io("fitted", fitted);
}

template <class Io, class R, if_record<R, ClusterShare> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, value] = record;
  io("name", name);
  io("value", value);
}

template <class Io, class R, if_record<R, ClusterModeRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[frequency, label, identity, shape, elastic, kinetic] = record;
  io("frequency", frequency);
  io("label", label);
  io("identity", identity);
  io("shape", shape);
  io("elastic", elastic);
  io("kinetic", kinetic);
}

template <class Io, class R, if_record<R, ClusterLoadRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, force, approach, tangent, secant] = record;
  io("name", name);
  io("force", force);
  io("approach", approach);
  io("tangent", tangent);
  io("secant", secant);
}

template <class Io, class R, if_record<R, ClusterHistoryRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[force, frequency, nonlinear, linear, difference, least_force, least_contact, events, first_opening,
         verdict] = record;
  io("force", force);
  io("frequency", frequency);
  io("nonlinear", nonlinear);
  io("linear", linear);
  io("difference", difference);
  io("least_force", least_force);
  io("least_contact", least_contact);
  io("events", events);
  io("first_opening", first_opening);
  io("verdict", verdict);
}

template <class Io, class R, if_record<R, ClusterPassRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, force, force_source, displacement, contacts, supports, modes, least_root, buckling_factor,
         buckling_motion, least_guides, leaving_force, leaving_contact, histories] = record;
  io("name", name);
  io("force", force);
  io("force_source", force_source);
  io("displacement", displacement);
  io("contacts", contacts);
  io("supports", supports);
  io("modes", modes);
  io("least_root", least_root);
  io("buckling_factor", buckling_factor);
  io("buckling_motion", buckling_motion);
  io("least_guides", least_guides);
  io("leaving_force", leaving_force);
  io("leaving_contact", leaving_contact);
  io("histories", histories);
}

template <class Io, class R, if_record<R, ClusterPublished> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, shape, frequency] = record;
  io("name", name);
  io("shape", shape);
  io("frequency", frequency);
}

template <class Io, class R, if_record<R, ClusterFitNumber> = 0> void each_member(Io &&io, R &record)
{
  auto &[key, start, value, interval] = record;
  io("key", key);
  io("start", start);
  io("value", value);
  io("interval", interval);
}

template <class Io, class R, if_record<R, ClusterFitFrequency> = 0> void each_member(Io &&io, R &record)
{
  auto &[mode, wanted, computed, fitted] = record;
  io("mode", mode);
  io("wanted", wanted);
  io("computed", computed);
  io("fitted", fitted);
}

template <class Io, class R, if_record<R, ClusterFitRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[variant, pass, set, numbers, frequencies, correlation, rms_fitted, rms_predicted, converged, undetermined,
         refused] = record;
  io("variant", variant);
  io("pass", pass);
  io("set", set);
  io("numbers", numbers);
  io("frequencies", frequencies);
  io("correlation", correlation);
  io("rms_fitted", rms_fitted);
  io("rms_predicted", rms_predicted);
  io("converged", converged);
  io("undetermined", undetermined);
  io("refused", refused);
}

template <class Io, class R, if_record<R, ClusterRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[rolls, contacts, supports, strip, passes, published, fits] = record;
  io("rolls", rolls);
  io("contacts", contacts);
  io("supports", supports);
  io("strip", strip);
  io("passes", passes);
  io("published", published);
  io("fits", fits);
}
}  // namespace mill
