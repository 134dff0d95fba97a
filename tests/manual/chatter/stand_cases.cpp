#include "core/model/case.h"
#include "dynamics/chatter/loop.h"
#include "dynamics/chatter/modes.h"
#include "dynamics/chatter/routh.h"
#include "dynamics/chatter/speed.h"
#include "tests/manual/bite/slab_models.h"
#include "tests/manual/chatter/models.h"
#include "tests/manual/check/verification.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <random>

// One stand coupled to its bite: eigenvalues, Routh's array, Nyquist's count, critical speed, phases.
namespace mill::verify {
std::vector<Case> chatter_calibration_cases();

namespace {
using namespace dynamics;
using mill::Linearisation;
using Complex = std::complex<double>;

WorkingPoint sequential(const int condition, const double speed)
{
  return working_point(film_bite(condition, speed), speed, Linearisation::sequential);
}

// CH-10
std::vector<Check> free_stand()
{
  const double undamped[6]  = {73.08991100380803, 93.71582595214466,  157.0149440772738,
                               322.9542385265556, 434.19561360316453, 435.5708713004121};
  const double damped[6][2] = {
      {73.0933379262347, 0.003975394998533902},   {93.71898227102821, 0.004694940581181249},
      {157.01139389485246, 0.009155923078555905}, {322.97983791783207, 0.009749438365972373},
      {434.18507382127666, 0.021082455409048146}, {435.5216797104498, 0.020320000069342096}};
  const FreeModes modes = free_modes(chatter_stand("D").structure);
  std::vector<Check> checks;
  for (int k = 0; k < 6; ++k)
    checks.push_back(
        relative(fmt::format("mode {}, undamped", k + 1), "Hz", modes.undamped[k], undamped[k], 1e-6));
  for (int k = 0; k < 6; ++k) {
    checks.push_back(
        relative(fmt::format("mode {}, with dampers", k + 1), "Hz", modes.frequency[k], damped[k][0], 1e-6));
    checks.push_back(relative(fmt::format("mode {}, ratio of critical damping", k + 1), "-", modes.damping[k],
                              damped[k][1], 1e-6));
  }
  return checks;
}

// CH-11
std::vector<Check> eigenvalues_of_stand_D()
{
  const double reference[8][2] = {{-0.025396653634118138, 128.1173539217457},
                                  {-0.6320395412827722, 81.3912461770561},
                                  {-14.202182135051444, 165.03153754309324},
                                  {-20.21951132650085, 324.42785427583857},
                                  {-56.54735627050155, 434.76688154712724},
                                  {-158.54057378263167, 0},
                                  {-324.22536578420545, 0},
                                  {-1432.7058666191647, 554.9612454560697}};
  const Eigen::VectorXcd roots = eigenvalues(chatter_matrix(chatter_stand("D"), sequential(2, 18.2).by));
  std::vector<Check> checks;
  checks.push_back(absolute("critical mode, growth rate", "1/s", roots[0].real(), reference[0][0], 1e-4));
  double largest = 0;
  Eigen::Index i = 0;
  for (const auto &[re, hertz] : reference) {
    const Complex root(re, 2 * M_PI * hertz);
    checks.push_back(relative(fmt::format("root of {:.1f} 1/s and {:.1f} Hz, modulus", re, hertz), "1/s",
                              std::abs(roots[i]), std::abs(root), 1e-6));
    largest = std::max(largest, std::abs(roots[i] - root) / std::abs(root));
    i += hertz > 0 ? 2 : 1;
  }
  checks.push_back(at_most("largest deviation of a root over its modulus", "-", largest, 1e-6));
  return checks;
}

// Eigenvalues to more digits than a double has: close to a pole of the structure, 1 - K_p G changes by 1e2 (with
// strong dampers 1e4) per 1/s, and the 4e-12 1/s of a double would be all one sees.
using FineComplex = std::complex<long double>;
using FineMatrix  = Eigen::Matrix<long double, -1, -1>;

// theory.md (25.4) with the digits of its eigenvalues: rounded to doubles, the entries of strong dampers move a
// root by what the loop shows as some 1e-10.
FineMatrix fine_chatter_matrix(const ChatterStandModel &stand, const bite::LinearCoefficients &by)
{
  const StandStructure &m = stand.structure;
  const Eigen::Index n    = m.n();
  const auto fine         = [](const double x) { return static_cast<long double>(x); };
  const auto row          = [&](const bite::StripRow &coefficients, const long double per_length) {
    FineMatrix r(1, 2 * n + 2);
    const FineMatrix gap = m.b.cast<long double>().transpose();
    r << per_length * fine(coefficients[0]) * gap, per_length * fine(coefficients[1]) * gap,
        per_length * fine(coefficients[2]), per_length * fine(coefficients[3]);
    return r;
  };
  FineMatrix A = FineMatrix::Zero(2 * n + 2, 2 * n + 2), motion = FineMatrix::Zero(n, 2 * n + 2);
  motion = m.b.cast<long double>() * row(by.force, 1);
  motion.leftCols(n) -= m.K.cast<long double>();
  motion.middleCols(n, n) -= m.C.cast<long double>();
  A.block(0, n, n, n).setIdentity();
  A.middleRows(n, n) = m.M.cast<long double>().partialPivLu().solve(motion);
  A.row(2 * n)       = row(by.entry_speed, fine(stand.strip_modulus) / fine(stand.entry_distance));
  A.row(2 * n + 1)   = row(by.exit_speed, -fine(stand.strip_modulus) / fine(stand.exit_distance));
  return A;
}

// The iteration of the solver leaves the rounding of the norm of the matrix; the quotient of the left and the
// right vector leaves that of their residual.
std::vector<FineComplex> fine_eigenvalues(const FineMatrix &A)
{
  using Matrix          = Eigen::Matrix<FineComplex, -1, -1>;
  const FineMatrix d    = balance(A.cast<double>()).cast<long double>();
  const FineMatrix even = d.col(0).cwiseInverse().asDiagonal() * A * d.col(0).asDiagonal();
  const Eigen::EigenSolver<FineMatrix> solver(even, true);
  const Matrix right = solver.eigenvectors(), left = right.inverse();
  std::vector<FineComplex> values;
  for (Eigen::Index k = 0; k < even.rows(); ++k) {
    const FineComplex s   = solver.eigenvalues()[k];
    const Matrix residual = even.cast<FineComplex>() * right.col(k) - s * right.col(k);
    values.push_back(s + (left.row(k) * residual)(0, 0) / (left.row(k) * right.col(k))(0, 0));
  }
  return values;
}

// 1 - K_p(s) G(s) in the digits of its root, written once more from chatter.md's scalar form: theory.md (25.7).
FineComplex fine_loop_difference(const ChatterStandModel &stand, const bite::LinearCoefficients &by,
                                 const FineComplex s)
{
  using Matrix            = Eigen::Matrix<FineComplex, -1, -1>;
  const StandStructure &m = stand.structure;
  const Matrix dynamic = s * s * m.M.cast<FineComplex>() + s * m.C.cast<FineComplex>() + m.K.cast<FineComplex>();
  const Matrix b       = m.b.cast<FineComplex>();
  const FineComplex G  = (b.transpose() * dynamic.partialPivLu().solve(b))(0, 0);
  const auto fine      = [](const double x) { return FineComplex(x); };
  const FineComplex entry = fine(stand.strip_modulus) / fine(stand.entry_distance),
                    exit  = fine(stand.strip_modulus) / fine(stand.exit_distance);
  // Entry and exit tension per unit of the gap, from their two equations.
  Matrix tensions(2, 2), motion(2, 1);
  tensions << s - entry * fine(by.entry_speed[2]), -entry * fine(by.entry_speed[3]), exit * fine(by.exit_speed[2]),
      s + exit * fine(by.exit_speed[3]);
  motion << entry * (fine(by.entry_speed[0]) + s * fine(by.entry_speed[1])),
      -exit * (fine(by.exit_speed[0]) + s * fine(by.exit_speed[1]));
  const Matrix t = tensions.partialPivLu().solve(motion);
  const FineComplex stiffness =
      fine(by.force[0]) + s * fine(by.force[1]) + fine(by.force[2]) * t(0, 0) + fine(by.force[3]) * t(1, 0);
  return fine(1) - stiffness * G;
}

// Of an entry in doubles, over the entry itself.
double largest_deviation(const Eigen::MatrixXd &doubles, const FineMatrix &fine)
{
  double largest = 0;
  for (Eigen::Index i = 0; i < fine.size(); ++i)
    if (fine(i) != 0 || doubles(i) != 0)
      largest = std::max(largest, double(std::abs((doubles(i) - fine(i)) / fine(i))));
  return largest;
}

// CH-12
std::vector<Check> scalar_loop()
{
  std::vector<Check> checks;
  for (const char *stand : {"D", "D36", "C", "A", "B"}) {
    const ChatterStandModel model = chatter_stand(stand);
    const WorkingPoint point      = sequential(2, 18.2);
    const FineMatrix matrix       = fine_chatter_matrix(model, point.by);
    double largest = 0, in_doubles = 0;
    for (const FineComplex s : fine_eigenvalues(matrix)) {
      largest    = std::max(largest, double(std::abs(fine_loop_difference(model, point.by, s))));
      in_doubles = std::max(in_doubles, std::abs(loop_difference(model, point.by, Complex(s))));
    }
    checks.push_back(
        at_most(fmt::format("stand {}: largest |1 - K_p(s) G(s)| over the 14 roots", stand), "-", largest, 1e-10));
    checks.push_back(at_most(fmt::format("stand {}: an entry of the program's matrix against this one", stand),
                             "-", largest_deviation(chatter_matrix(model, point.by), matrix), 1e-15));
    if (stand == std::string("D"))  // of the others a double of s says no more than its rounding
      checks.push_back(at_most("stand D: the same by the program, in doubles", "-", in_doubles, 1e-10));
  }
  return checks;
}

struct Reference {
  const char *name;
  const char *stand;
  Linearisation scheme;
  double speed[2];      ///< m/s, conditions 1 and 2
  double frequency[2];  ///< Hz; 0: none given
};

// CH-13
std::vector<Check> critical_speeds()
{
  const Reference rows[] = {
      {"D, in sequence",
       "D",
       Linearisation::sequential,
       {18.646221249626493, 18.207252873709336},
       {127.92992373205635, 128.11380277994402}},
      {"D36, in sequence",
       "D36",
       Linearisation::sequential,
       {18.637323657802973, 18.202792653365723},
       {0, 131.85914626263505}},
      {"C, in sequence",
       "C",
       Linearisation::sequential,
       {18.70208596184084, 18.198251158906153},
       {0, 81.33758371254967}},
      {"A, in sequence",
       "A",
       Linearisation::sequential,
       {18.669901880143016, 18.20004216035359},
       {0, 100.51660990694417}},
      {"B, in sequence",
       "B",
       Linearisation::sequential,
       {18.664211124211583, 18.195786551768776},
       {0, 105.79923439596521}},
      {"D, implicit", "D", Linearisation::implicit, {19.49071588076472, 19.22846269597016}, {0, 0}},
      {"D, friction frozen",
       "D",
       Linearisation::frozen_friction,
       {18.084856822880358, 17.589384110545772},
       {0, 0}},
  };
  std::vector<Check> checks;
  for (const Reference &r : rows)
    for (const int c : {0, 1}) {
      const StandSpeed critical = critical_speed(chatter_stand(r.stand), film_bite(c + 1, 18), r.scheme);
      const std::string where   = fmt::format("stand {}, condition {}: ", r.name, c + 1);
      checks.push_back(absolute(where + "critical speed", "m/s", critical.speed, r.speed[c], 1e-5));
      if (r.frequency[c] > 0)
        checks.push_back(relative(where + "frequency", "Hz", critical.frequency, r.frequency[c], 1e-6));
    }
  return checks;
}

// CH-14, with pitfall 9
std::vector<Check> routh()
{
  const double reference[2] = {18.646221249626493, 18.207252873709336};
  std::vector<Check> checks;
  for (const int c : {0, 1}) {
    const auto matrix = matrix_at_speed(chatter_stand("D"), film_bite(c + 1, 18), Linearisation::sequential);
    checks.push_back(absolute(fmt::format("stand D, condition {}: critical speed by halving", c + 1), "m/s",
                              boundary_by_routh(matrix, 18, 19, 1e-7), reference[c], 2e-6));
  }
  const Eigen::MatrixXd B = chatter_matrix(chatter_stand("B"), sequential(2, 17).by);
  checks.push_back(absolute("stand B at 17 m/s: unstable roots by the array", "-", unstable_roots(B), 0, 0));
  checks.push_back({"the same in double precision, which is wrong", "-", double(routh_count_in_double(B).unstable),
                    1, 0, Judged::at_least});
  return checks;
}

// CH-15: force up on the upper and down on the lower work roll, but the gap as if both moved away from the strip.
std::vector<Check> printed_signs()
{
  const double reference[4][2] = {
      {5, 441.9202271066167}, {10, 282.6156280207774}, {18.2, 222.85527668973415}, {30, 217.22478866829113}};
  std::vector<Check> checks;
  const ChatterStandModel stand = chatter_stand("D");
  for (const auto &[speed, growth] : reference) {
    const bite::LinearCoefficients by = sequential(2, speed).by;
    Eigen::MatrixXd A                 = chatter_matrix(stand, by);
    bite::LinearCoefficients free     = by;
    free.force                        = {};
    A.row(9) -= 2 * (A.row(9) - chatter_matrix(stand, free).row(9));  // lower work roll
    checks.push_back(relative(fmt::format("growth rate at {:g} m/s", speed), "1/s", growth_rate(A), growth, 1e-4));
  }
  return checks;
}

// CH-16
std::vector<Check> damping_of_the_process()
{
  const double reference[6][2] = {{5, -267432187.53105628},   {10, -34215094.51263139}, {15, -6191209.480902709},
                                  {18.2, 1351803.0163470246}, {20, 4452412.31656958},   {25, 11175389.73128753}};
  std::vector<Check> checks;
  for (const auto &[speed, damping] : reference)
    checks.push_back(relative(fmt::format("Im K_p(i w)/w at {:g} m/s", speed), "MN s/m",
                              process_damping(chatter_stand("D"), sequential(2, speed).by, 128) / 1e6,
                              damping / 1e6, 1e-6));
  return checks;
}

// CH-24
std::vector<Check> damping_scales()
{
  const double reference[6][3] = {{0, 12.435734348603605, 12.230675081285158},
                                  {1e4, 13.467114435254304, 13.22882515189292},
                                  {1e5, 18.646221249626493, 18.207252873709336},
                                  {1e6, 24.391233658324303, 23.471044631448045},
                                  {1e7, not_given, not_given},
                                  {1e8, 21.95365502706575, 21.239077183647048}};
  std::vector<Check> checks;
  for (const auto &row : reference)
    for (const int condition : {1, 2}) {
      const SpeedRange range{1, 32};
      const CriticalSpeed critical = critical_speed(chatter_stand(stand_on_damping_scale(row[0])),
                                                    film_bite(condition, 18), Linearisation::sequential, range);
      const std::string where      = fmt::format("scale {:g} N s/m, condition {}: ", row[0], condition);
      if (std::isnan(row[condition])) {
        checks.push_back(
            absolute(where + "speeds at which a root grows up to 32 m/s", "-",
                     double(critical.crossings.size()) + (critical.verdict != dynamics::Verdict::stable), 0, 0));
        checks.push_back(reported(where + "largest growth rate", "1/s", critical.margin, 0));
      } else
        checks.push_back(absolute(where + "critical speed", "m/s", critical.speed, row[condition], 1e-5));
    }
  return checks;
}

// Six masses drawn at random, the same in every run: the generator is defined by the standard, and the numbers are
// made from its integers here.
class RandomStands {
public:
  SixMasses next()
  {
    SixMasses stand;
    for (int i = 0; i < 6; ++i) {
      const bool work_roll = i == 2 || i == 3;
      stand.mass[i]        = work_roll ? between(4e3, 3e4) : between(2e4, 2e5);
      stand.stiffness[i]   = between(1e10, 1.2e11);
      stand.damping[i]     = std::pow(10, between(4, 6.5));
    }
    stand.distance = between(2, 8);
    return stand;
  }

private:
  double between(const double low, const double high)
  {
    return low + (high - low) * double(draw_()) / 4294967296.;
  }
  std::mt19937 draw_{1};
};

std::vector<Check> three_counts()
{
  RandomStands stands;
  int systems = 0, routh_differs = 0, nyquist_differs = 0, unstable = 0;
  double largest = 0;
  for (int i = 0; i < 40; ++i) {
    const ChatterStandModel stand = chatter_stand(stands.next());
    const int condition           = 1 + i % 3;
    const auto scheme             = Linearisation(i % 3);
    for (const double speed : {5, 10, 15, 20, 25, 30}) {
      const auto by           = working_point(film_bite(condition, speed), speed, scheme).by;
      const Eigen::MatrixXd A = chatter_matrix(stand, by);
      const int roots         = int((eigenvalues(A).real().array() > 0).count());
      ++systems;
      unstable += roots > 0;
      routh_differs += unstable_roots(A) != roots;
      nyquist_differs += nyquist_count(stand, by).unstable != roots;
    }
    if (i % 8 > 0)
      continue;
    const CriticalSpeed critical = critical_speed(stand, film_bite(condition, 18), scheme);
    if (critical.verdict == dynamics::Verdict::crossing)
      largest =
          std::max(largest, std::abs(boundary_by_routh(matrix_at_speed(stand, film_bite(condition, 18), scheme),
                                                       critical.speed - 0.02, critical.speed + 0.02) -
                                     critical.speed));
  }
  return {reported("systems of which some root grows, of all", "-", unstable, systems),
          absolute("systems in which Routh's array has another number of roots", "-", routh_differs, 0, 0),
          absolute("systems in which Nyquist's criterion has another number of roots", "-", nyquist_differs, 0, 0),
          at_most("critical speeds of five of the stands, largest difference to Routh's", "m/s", largest, 1e-6)};
}
}  // namespace

std::vector<Case> chatter_stand_cases()
{
  const std::string liu = chatter_source, stands = chatter_stands;
  std::vector<Case> cases;
  const auto add = [&](const char *name, const char *kind, const std::string &problem, const std::string &source,
                       const char *reason, std::vector<Check> (*run)()) {
    cases.push_back({name, kind, problem, source, reason, run});
  };
  add("chatter-free-modes", "regression",
      "Stand D, a four-high of six masses without strip: natural frequencies and ratios of critical damping.",
      liu + "stand_D.frequencies, stand_D.damping", "1e-6: eigenvalues of 6 x 6 and 12 x 12 matrices.",
      free_stand);
  add("chatter-eigenvalues", "regression",
      stands + "Stand D in condition 2 at 18.2 m/s, derivatives in sequence: 14 eigenvalues.",
      liu + "eigenvalues.condition_2",
      "1e-6 of the modulus; 1e-4 1/s for the growth rate of the critical mode, a difference of terms 1e4 times as "
      "large.",
      eigenvalues_of_stand_D);
  add("chatter-scalar-loop", "verification",
      stands +
          "Condition 2 at 18.2 m/s: the force of the bite per gap, tensions eliminated by hand, times the gap "
          "of the structure per force is 1 at every eigenvalue of the 14 x 14 matrix, which is written once more "
          "in "
          "long double; the program's entries are these, rounded.",
      "theory.md (25.7): determinant of the coupled system",
      "1e-10: rounding of the loop next to a pole of the structure. 1e-15: an entry of the matrix is a sum and "
      "two "
      "products or quotients of doubles, each rounded by 1.1e-16, of terms that do not cancel.",
      scalar_loop);
  add("chatter-critical-speed", "regression",
      stands +
          "Lowest roll speed at which a mode begins to grow, with the steady bite solved again at every speed: "
          "five variants of the stand in two conditions, and stand D in two further linearisations. The "
          "distances of the stands were fitted to 18.2 m/s in condition 2, in sequence: these rows are "
          "regression values, those of condition 1 and of the other linearisations follow.",
      liu + "v_crit.*", "1e-5 m/s: root finding of the reference; 1e-6 of the frequency.", critical_speeds);
  add("chatter-routh", "verification",
      stands +
          "Critical speed without eigenvalues: characteristic polynomial and Routh's array in 100 digits, "
          "halving. For comparison stand B, whose dampers of 1e8 N s/m spread the roots over five decades: there "
          "the same array in double precision finds unstable roots where none is.",
      liu + "v_crit.D.seq, by eigenvalues", "2e-6 m/s: halving; numbers of roots exact.", routh);
  add("chatter-printed-signs", "regression",
      stands + "Negative test: with the signs as printed in the source (force of opposite sign on the work rolls, "
               "gap as their sum) stand D in condition 2 is unstable at every speed.",
      liu + "as_printed_signs", "1e-4: largest of 14 eigenvalues.", printed_signs);
  add("chatter-process-damping", "regression",
      stands + "What bite and tensions take from or add to the damping of the gap at 128 Hz in condition 2: it "
               "changes its sign between 15 and 18.2 m/s.",
      liu + "process_damping", "1e-6: closed form of exact derivatives.", damping_of_the_process);
  add("chatter-damping-scale", "regression",
      stands + "Stand D at 4.95 m between the stands with all its dampers on scales from none to 1e8 N s/m.",
      liu + "damping_exponent", "1e-5 m/s: root finding of the reference; stable throughout: exact.",
      damping_scales);
  add("chatter-three-counts", "verification",
      "Forty four-highs of random masses, springs, dampers and distances in three conditions and three "
      "linearisations from 5 to 30 m/s: number of growing roots by eigenvalues, by Routh's array and by the "
      "winding "
      "of Nyquist's curve.",
      "three methods that share nothing but the matrix", "numbers of roots: exact; 1e-6 m/s: halving.",
      three_counts);
  for (const Case &c : chatter_calibration_cases())
    cases.push_back(c);
  return cases;
}
}  // namespace mill::verify
