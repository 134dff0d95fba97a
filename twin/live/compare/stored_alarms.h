#pragma once
#include "twin/live/compare/alarm_book.h"
#include "twin/live/compare/stored_object.h"
#include <nlohmann/json_fwd.hpp>

namespace mill::live {
nlohmann::json alarm_json(const PageAlarm &alarm);
/// @throws DamagedState
PageAlarm stored_alarm(const StoredObject &stored);

nlohmann::json book_json(const AlarmBook::State &book);
/// @throws DamagedState
AlarmBook::State stored_book(const StoredObject &stored);
}  // namespace mill::live
