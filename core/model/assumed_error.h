#pragma once

namespace mill {
/// -, relative error of a spring or mass for which nothing states one
constexpr double assumed_spring_error = 0.10;
}  // namespace mill
