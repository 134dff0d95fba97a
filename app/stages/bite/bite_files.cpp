#include "app/stages/bite/bite_files.h"
#include "app/run/curve_files.h"
#include "core/records/csv.h"
#include <cmath>

namespace mill {
namespace {
void write_arc(RunContext &run, const std::string &pass, const BiteAnswer &answer)
{
  const bite::BiteState &s = answer.state;
  Table t;
  t.add("x", "m", s.position).add("thickness", "m", s.thickness).add("pressure", "Pa", s.pressure);
  t.add("shear", "Pa", s.shear).add("slip", "", s.slip);
  write_curve(run, curve::bite_arc, pass, t, answer.key);
}

// Roll and strip along the contact: heights over the middle plane of the strip.
void write_roll(RunContext &run, const std::string &pass, const BiteStudy &study)
{
  const fem::StripFlow &f = study.flow->fine;
  const double R          = study.question.bite.roll_radius;
  const Eigen::Index n    = f.roll_surface.size();
  if (n == 0)
    return;
  const Eigen::VectorXd x     = f.x.col(f.x.cols() - 1).segment(f.first_contact, n),
                        strip = f.y.col(f.y.cols() - 1).segment(f.first_contact, n);
  // The circle is hung where the loaded roll is nearest to the middle plane: rigid and loaded roll are compared at
  // one gap.
  const double lowest          = f.roll_surface.minCoeff();
  const Eigen::VectorXd circle = lowest + R - (R * R - x.array().square()).sqrt();
  Table t;
  t.add("x", "m", x).add("circle", "m", circle).add("roll", "m", f.roll_surface).add("strip", "m", strip);
  write_curve(run, curve::bite_arc, pass, t, "roll");
}

void write_field(RunContext &run, const std::string &pass, const fem::StripFlow &f)
{
  const auto flat = [&](const Eigen::MatrixXd &m) {  // column by column of the mesh, axis first
    Eigen::VectorXd out(m.size());
    for (Eigen::Index i = 0, k = 0; i < m.rows(); ++i)
      for (Eigen::Index j = 0; j < m.cols(); ++j)
        out[k++] = m(i, j);
    return out;
  };
  Table t;
  t.add("x", "m", flat(f.x)).add("y", "m", flat(f.y)).add("strain", "", flat(f.strain));
  t.add("strain_rate", "1/s", flat(f.rate)).add("pressure", "Pa", flat(f.pressure));
  t.add("velocity_x", "m/s", flat(f.vx)).add("velocity_y", "m/s", flat(f.vy));
  write_curve(run, curve::bite_arc, pass, t, "field");
}
// What stays in the strip behind the bite.
void write_outlet(RunContext &run, const std::string &pass, const FlowAnswer &flow)
{
  if (flow.outlet_height.size() == 0)
    return;
  Table t;
  t.add("y", "m", flow.outlet_height).add("stress", "Pa", flow.outlet_stress);
  write_curve(run, curve::bite_outlet, pass, t);
}
}  // namespace

// What a file holds stands behind a point, which no slug has: passes "x" and "x-fe" share no name.
void write_bite(RunContext &run, const BiteStudy &study)
{
  const std::string pass = slug(study.question.pass);
  for (const BiteAnswer &answer : study.answers)
    if (answer.refused.empty())
      write_arc(run, pass, answer);
  if (!study.flow)
    return;
  write_roll(run, pass, study);
  write_field(run, pass, study.flow->fine);
  if (std::isnan(study.question.bite.roll_speed))
    run.assume("bite of " + study.question.pass +
               ": no speed is given; strain rates and velocities of its pictures belong to rolls at 1 m/s");
  write_outlet(run, pass, *study.flow);
  fem::write_strip_flow_vtu(run.out.file("fields/bite-" + pass + ".vtu"), study.flow->fine);
}
}  // namespace mill
