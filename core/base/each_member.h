#pragma once
#include <type_traits>

// A record is a struct with a function in its namespace that hands every member with its name to `io`:
//   template <class Io, class R, if_record<R, Point> = 0> void each_member(Io &&io, R &record)
//   {
//     auto &[x, y] = record;
//     io("x", x);
//     io("y", y);
//   }
// The structured binding takes apart the whole struct: a member that is added to it and not named here does not
// compile.  One list serves reading, writing, comparing and the keys of kept results.
namespace mill {
/// Accepts a record and a constant one.
template <class R, class Record>
using if_record = std::enable_if_t<std::is_same_v<std::remove_const_t<R>, Record>, int>;
}  // namespace mill
