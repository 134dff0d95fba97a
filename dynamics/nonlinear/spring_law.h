#pragma once
#include <vector>

// The force of a contact or a bearing over its compression, and a step of a stand on such springs.  Standard
// library alone, no Eigen: these files travel inside an exported unit as they are, side by side in one folder,
// hence their includes without one.  theory.md 36.1
namespace mill::dynamics {
/// Force and slope at one compression.
struct SpringForce {
  double force     = 0;  ///< N
  double stiffness = 0;  ///< N/m, d force / d compression
};

/// A spring that only pushes: zero force below zero compression, rising above it.  Made from samples of load and
/// compression, which it meets: cubic in ln(compression) over ln(load) between them, the power law of the
/// outermost sample beyond them (36.2), so that force and stiffness vanish together where the bodies part.
class SpringLaw {
public:
  SpringLaw() = default;

  /// @param load         N, increasing, > 0, at least two
  /// @param compression  m, increasing, > 0, as many
  /// Cost: some thousand logarithms.  Returns an unusable law (usable() false) for samples that are not so.
  SpringLaw(const std::vector<double> &load, const std::vector<double> &compression);

  bool usable() const
  {
    return !force_.empty();
  }

  /// The same spring in series with a linear one.  @param compliance  m/N; negative: so much is taken away
  /// Unusable where less than nothing would be left somewhere.
  SpringLaw in_series_with(double compliance) const;

  SpringForce at(double compression) const;
  /// J, work of the force from zero compression: exactly the integral of at().
  double energy(double compression) const;
  /// m, the compression under a load (N) >= 0.
  double compression(double load) const;

  double least_load() const  ///< N, of the samples
  {
    return load_.front();
  }
  double largest_load() const  ///< N, of the samples
  {
    return load_.back();
  }

  // What the law was made from: with it another place makes the same law, to the last digit.
  const std::vector<double> &sample_loads() const  ///< N
  {
    return load_;
  }
  const std::vector<double> &sample_compressions() const  ///< m
  {
    return compression_;
  }
  double series_compliance() const  ///< m/N, of the linear springs in series
  {
    return compliance_;
  }

private:
  void tabulate();
  void set_slopes();
  double sampled_compression(double load, double &slope) const;

  std::vector<double> load_, compression_, slope_;  // N, m, d ln compression / d ln load
  double compliance_ = 0;                           // m/N, of the linear spring in series
  // Between begin_ and end_ force, stiffness and energy on even steps; cubics between them.
  double begin_ = 0, end_ = 0, step_ = 1;
  double low_power_ = 1, high_power_ = 1;  // d ln force / d ln compression beyond the ends
  std::vector<double> force_, stiffness_, energy_;
};
}  // namespace mill::dynamics
