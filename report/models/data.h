#pragma once
#include <Eigen/Core>
#include <limits>
#include <map>
#include <string>
#include <vector>

// Models of one stand and what they say about each other, as the run stored them in curves/models.json.  A number
// that was not stored is NaN, a list that was not stored is empty.
namespace mill::report {
struct ModelMode {
  double frequency;                    ///< Hz
  double error_estimate;               ///< relative, of the frequency
  double in_chain;                     ///< 0 .. 1, share of its motion that six masses can follow
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

struct Model {
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
  int mode;          ///< from 1
  double frequency;  ///< Hz
  double mac;        ///< 0 .. 1, how alike the shapes are
};

struct ModePair {
  int mode;                                ///< of the six masses, from 1
  double six_mass;                         ///< Hz
  std::map<std::string, Partner> partner;  ///< by name of the other model
};

struct MacTable {
  std::string rows, columns;                        ///< names of two models
  Eigen::VectorXd row_frequency, column_frequency;  ///< Hz
  Eigen::MatrixXd values;                           ///< (rows, columns) 0 .. 1
};

/// A stand reduced to so many masses.
struct MassCount {
  int masses;
  std::string added;   ///< what the last mass stands for
  double worst_error;  ///< relative, of the modes below the limit
  int right;           ///< modes that count as right
  int modes_below_limit;
  std::vector<double> missing;  ///< Hz
};

struct KeptModes {
  std::vector<int> kept;      ///< (n) modes kept of each part
  Eigen::VectorXd frequency;  ///< (m) Hz
  Eigen::MatrixXd error;      ///< (n, m) relative
};

struct MassPart {
  std::string name;
  double mass;        ///< kg, on the scales
  double equivalent;  ///< kg, what it adds to the equivalent mass
};

struct MassBreakdown {
  std::string mass;   ///< "M2"
  std::string route;  ///< "chain", "finite elements"
  std::vector<MassPart> parts;
};

struct MassRoutes {
  std::string mass;                                ///< "M2"
  double chain, fe_integral, fe_solid, published;  ///< kg
};

struct ModelData {
  bool stored = false;
  std::string problem;  ///< why a file that is there cannot be used; empty: nothing wrong
  double frequency_limit =
      std::numeric_limits<double>::quiet_NaN();  ///< Hz, up to which the modes are to be right
  std::string at;                                ///< load of the tangents, "976.2 kN"
  std::string driven;                            ///< name of the model that the responses of this run come from
  std::vector<std::string> answer, warnings;
  std::vector<Model> models;
  std::vector<ModePair> pairs;
  MacTable mac;
  std::vector<MassCount> masses_needed;
  KeptModes kept_modes;
  std::vector<MassBreakdown> breakdown;
  std::vector<MassRoutes> routes;

  const Model *find(const std::string &name) const;  ///< nullptr when absent
  std::string title(const std::string &name) const;  ///< of a model, else the name itself
  /// The model that the six masses are judged by: the last one that has other modes than theirs; nullptr: none.
  const Model *detailed() const;
};

/// Reads curves/models.json of a run directory.  Never throws: without the file `stored` is false, with one that
/// is no such JSON `problem` says so.  Lists of a mode whose length does not fit its model are filled up with NaN.
ModelData read_models(const std::string &run_directory);
}  // namespace mill::report
