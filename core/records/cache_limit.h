#pragma once
#include <string>

namespace mill {
/// Bytes of "20GB" (MB, GB, TB).
/// @param option  as the message names it, "--cache-limit"
/// @throws InputError  another form, nothing above zero
double bytes_of_size(const std::string &option, const std::string &text);

/// Removes entries of a cache folder, those that were not used for longest first, until it is not larger than the
/// limit.  read_cache_entry() notes the use of an entry as its time of change.  What another process reads at the
/// moment stays readable for it.
/// @return bytes that were removed
/// Cost: one look at each entry.
double keep_cache_below(const std::string &folder, double bytes);
}  // namespace mill
