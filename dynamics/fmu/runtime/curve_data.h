#pragma once
#include <string>
#include <vector>

// The part of resources/model.json that only kind "curves" has: springs of the stand that follow their curves.
namespace mill::fmu {
/// Force of a spring over its compression, by samples.
struct CurveLawData {
  std::vector<double> load;         ///< N, increasing, above zero
  std::vector<double> compression;  ///< m, increasing, above zero
  double series_compliance = 0;     ///< m/N, of a linear spring in series
};

/// One spring on a curve, or one place of a contact line.
struct CurveSpringData {
  std::string name;         ///< "K3"
  int law          = 0;     ///< place in CurveData::laws
  double share     = 1;     ///< -, part of the force of the law that acts here
  double rest      = 0;     ///< m, compression under the mean force
  double force     = 0;     ///< N, of the law there
  double stiffness = 0;     ///< N/m, slope there, in the frequencies of the modes
  std::vector<double> row;  ///< (n) kg^-1/2, compression per modal displacement
};

struct CurveData {
  double longest_step = 0;  ///< s, of the steps inside a communication step
  std::vector<CurveLawData> laws;
  std::vector<CurveSpringData> springs;
};

template <class IO, class L> void each_member(IO &io, L &law, const CurveLawData *)
{
  io("load", law.load);
  io("compression", law.compression);
  io("series_compliance", law.series_compliance);
}
template <class IO, class S> void each_member(IO &io, S &spring, const CurveSpringData *)
{
  io("name", spring.name);
  io("law", spring.law);
  io("share", spring.share);
  io("rest", spring.rest);
  io("force", spring.force);
  io("stiffness", spring.stiffness);
  io("row", spring.row);
}
template <class IO, class C> void each_member(IO &io, C &curves, const CurveData *)
{
  io("longest_step", curves.longest_step);
  io("laws", curves.laws);
  io("springs", curves.springs);
}
}  // namespace mill::fmu
