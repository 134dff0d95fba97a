# The manual, one entry per group of cases (verify::groups()); a failure prints the table of the case.
set(manual_groups ClosedForms HalfSpace Section Solid Friction Nonlinear Roll
                  Bearing Roller Ring BearingMotion
                  Slab Inhomogeneous ElasticArc StripFlow StripElastic RollArc
                  Mass Component Housing
                  ChatterStand ChatterMotion ChatterSensitivity ChatterTandem)
add_executable(verification_manual_test verification/verification_manual_test.cpp)
target_link_libraries(verification_manual_test PRIVATE mill::verify mill_test_support mill_options)
target_compile_definitions(verification_manual_test PRIVATE MILLSTAND_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
foreach(group ${manual_groups})
  add_test(NAME manual_${group}
    COMMAND verification_manual_test --gtest_filter=Manual/GroupOfCases.Passes/${group} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(manual_${group} PROPERTIES LABELS verification TIMEOUT 300)
endforeach()

# The long form, "ctest -C long": comparisons with CalculiX, skipped where it is not installed.
list(APPEND manual_groups Peer)
add_test(NAME manual_Peer CONFIGURATIONS long
  COMMAND verification_manual_test --gtest_filter=Manual/GroupOfCases.Passes/Peer WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
set_tests_properties(manual_Peer PROPERTIES LABELS peer TIMEOUT 1800 SKIP_REGULAR_EXPRESSION "SKIPPED")

# Compares this list with the groups of the program: a group that is missing here would never run.
mill_test(verification_test LABEL unit LINK mill::verify)
string(REPLACE ";" "," manual_groups "${manual_groups}")
target_compile_definitions(verification_test PRIVATE MANUAL_GROUPS="${manual_groups}")
