#include "reduce/chain/frame_closure.h"
#include "core/base/errors.h"
#include "core/case/stand_rows.h"
#include <cmath>
#include <fmt/format.h>

namespace mill::reduce {
namespace {
template <class Visit> void each_closing(const Frame &frame, const Visit &visit)
{
  for (const Field<Frame> &row : frame_rows())
    if (frame.closing.count(row.key))
      visit(std::get<double Frame::*>(row.member));
}
}  // namespace

bool is_closed(const Frame &frame)
{
  return !std::isnan(frame.modulus) && !frame.closing.empty();
}

double closing_compliance(const Frame &frame)
{
  double sum = 0;
  each_closing(frame, [&](double Frame::*K) { sum += 1 / frame.*K; });
  return sum;
}

Frame with_closing_compliance(Frame frame, const double compliance)
{
  const double stiffer = closing_compliance(frame) / compliance;
  each_closing(frame, [&](double Frame::*K) { frame.*K *= stiffer; });
  return frame;
}

Frame closed_on_modulus(Frame frame, const double rest)
{
  const double left = 1 / frame.modulus - rest;  // (30.11)
  if (!(left > 0))
    throw InputError(
        frame.modulus_place,
        fmt::format(
            "frame.modulus = {:.4g} MN/mm leaves nothing for the frame: with touching work rolls the rolls, their "
            "contacts and bearings and what is given of the frame have {:.4g} MN/mm together, and the whole stand "
            "is "
            "softer than that; give the slope of force over screw position of both housings together, or correct "
            "rolls and bearings",
            frame.modulus / 1e9, 1 / rest / 1e9));
  return with_closing_compliance(std::move(frame), left);
}
}  // namespace mill::reduce
