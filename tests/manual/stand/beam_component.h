#pragma once
#include "core/model/roll.h"
#include "core/records/component.h"
#include <string>

namespace mill::verify {
/// Component of a roll made from a fine Timoshenko beam instead of finite elements, by the same algebra: barrel
/// functions and seat held, static shapes by a bordered system, modes with the interface held, residual of those
/// left out.
/// @param n_barrel  number of Legendre functions of the barrel
/// @param limit     Hz, modes with the interface held up to here are kept
/// @param elements  per span of the roll
Component beam_component(const std::string &name, const Roll &roll, const Material &steel, int n_barrel,
                         double limit, int elements = 64);
}  // namespace mill::verify
