#include "app/stages/bite/kept_remarks.h"
#include "core/records/json_archive.h"

namespace mill {
namespace {
struct KeptRemarks {
  std::vector<Warning> remarks;
};
template <class Io, class R, if_record<R, KeptRemarks> = 0> void each_member(Io &&io, R &record)
{
  auto &[remarks] = record;
  io("remarks", remarks);
}
}  // namespace

std::string text_of_remarks(const std::vector<Warning> &remarks)
{
  return json_of_record(KeptRemarks{remarks});
}

std::vector<Warning> remarks_of_text(const std::string &text)
{
  return record_of_json<KeptRemarks>(text).remarks;
}
}  // namespace mill
