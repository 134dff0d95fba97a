#include "app/twin/live/sample_account.h"
#include "core/base/visible_text.h"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill {
std::vector<live::AccountRow> account_rows(const live::Engine &engine)
{
  std::vector<live::AccountRow> rows;
  const auto &source = engine.source();
  for (std::size_t c = 0; source && c < source->channels.size(); ++c) {
    const live::ChannelAccount &a = engine.book()->channels()[c];
    rows.push_back({source->channels[c].name, a.offered, a.processed, a.missing, a.rejected, a.overrun});
  }
  return rows;
}

std::string account_json(const live::Engine &engine)
{
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const live::AccountRow &row : account_rows(engine))
    json["channels"][row.channel] = {{"offered", row.offered},
                                     {"processed", row.processed},
                                     {"missing", row.missing},
                                     {"rejected", row.rejected},
                                     {"overrun", row.overrun}};
  if (engine.book()) {
    json["doubled"]       = engine.book()->doubled();
    json["gaps"]          = engine.book()->gaps();
    json["refused_lines"] = engine.refused_lines();
  }
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string account_table(const live::Engine &engine)
{
  if (!engine.source() || !engine.book())
    return "";
  constexpr const char *row_format = "{:<24} {:>12} {:>12} {:>12} {:>12} {:>12}\n";
  std::string table = fmt::format(row_format, "samples", "offered", "processed", "missing", "rejected", "overrun");
  for (const live::AccountRow &row : account_rows(engine))
    table += fmt::format(row_format, visible(row.channel, true), row.offered, row.processed, row.missing,
                         row.rejected, row.overrun);
  return table + fmt::format("{} gaps, {} samples doubled, {} lines refused\n", engine.book()->gaps(),
                             engine.book()->doubled(), engine.refused_lines());
}
}  // namespace mill
