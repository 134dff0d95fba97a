#pragma once
#include <string>

/// A four-high of which two rolls are drawn and everything behind the springs and masses is given: no frame, no
/// bearing, no flow stress.
inline std::string given_stand()
{
  return R"(schema = 1
kind = "four-high"
[work_roll]
barrel_diameter = "420 mm"
barrel_length = "1400 mm"
neck_diameter = "266.7 mm"
total_length = "2320 mm"
bearing_span = "2000 mm"
[backup_roll]
barrel_diameter = "1450 mm"
barrel_length = "1400 mm"
neck_diameter = "950 mm"
neck_length = "950 mm"
bearing_span = "2450 mm"
[strip]
width = "1000 mm"
[[pass]]
name = "pass 1"
load = "976 kN"
[given]
M1 = "9320 kg"
M2 = "59720 kg"
M3 = "1889 kg"
M4 = "3095 kg"
M5 = "42200 kg"
M6 = "4663 kg"
K1 = "6.3086e3 kN/mm"
K2 = "1.0e4 kN/mm"
K3 = "4.0e4 kN/mm"
K4 = "1.9e5 kN/mm"
K5 = "4.0e4 kN/mm"
K6 = "2.6e4 kN/mm"
K7 = "6.8789e3 kN/mm"
K_Zy = "1.02e5 kN/mm"
Kzc2 = "2.01e4 kN/mm"
Kzc3 = "2.01e4 kN/mm"
)";
}
