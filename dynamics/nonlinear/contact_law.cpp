#include "dynamics/nonlinear/contact_law.h"
#include <Eigen/QR>
#include <cmath>

namespace mill::dynamics {
SmoothSamples smooth_contact(const Eigen::VectorXd &load, const Eigen::VectorXd &compression)
{
  constexpr double most_deviation = 5e-3;
  constexpr int kept              = 48;  // loads at which the form is sampled
  const Eigen::Index n            = load.size();
  for (const Eigen::Index degree : {2, 4}) {
    if (n < degree + 3)
      break;
    const double low = load[0], ratio = std::log(load[n - 1] / low);
    const auto powers = [&](const double F) {
      Eigen::RowVectorXd row(degree + 1);
      row[0] = 1;
      for (Eigen::Index k = 1; k <= degree; ++k)
        row[k] = row[k - 1] * std::log(F / low) / ratio;
      return row;
    };
    Eigen::MatrixXd form(n, degree + 1);
    for (Eigen::Index i = 0; i < n; ++i)
      form.row(i) = powers(load[i]) * load[i] / compression[i];
    const Eigen::VectorXd c = form.colPivHouseholderQr().solve(Eigen::VectorXd(Eigen::VectorXd::Ones(n)));
    SmoothSamples smooth;
    smooth.deviation = (form * c - Eigen::VectorXd::Ones(n)).cwiseAbs().maxCoeff();
    if (!(smooth.deviation <= most_deviation))
      continue;
    for (int i = 0; i < kept; ++i) {
      const double F = i + 1 == kept ? load[n - 1] : low * std::exp(ratio * i / (kept - 1));
      smooth.load.push_back(F);
      smooth.compression.push_back(F * powers(F).dot(c));
    }
    return smooth;
  }
  return {{load.begin(), load.end()}, {compression.begin(), compression.end()}, 0};
}
}  // namespace mill::dynamics
