# The manual, one entry per group of cases (verify::groups()); a failure prints the table of the case.
set(manual_groups ClosedForms HalfSpace Section Solid Friction Nonlinear Roll
                  Bearing Roller Ring OilFilm BearingMotion
                  Slab Inhomogeneous ElasticArc StripFlow StripElastic RollArc
                  Mass Component Housing Response
                  ChatterStand ChatterMotion ChatterSensitivity ChatterTandem)
# verification_test compares this list with the groups of the program: a group that is missing here would never run.
string(REPLACE ";" "," all_groups "${manual_groups};Peer")
mill_tests(verify LINK mill::verify mill::bite mill::fem_linked SUPPORT manual/manual_test.cpp DEFINE MANUAL_GROUPS="${all_groups}")

foreach(group ${manual_groups})
  add_test(NAME manual_${group}
    COMMAND verify_tests --gtest_filter=Manual/GroupOfCases.Passes/${group} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(manual_${group} PROPERTIES LABELS verification TIMEOUT 300)
endforeach()

# The long form, "ctest -C long": comparisons with CalculiX, skipped where it is not installed.
add_test(NAME manual_Peer CONFIGURATIONS long
  COMMAND verify_tests --gtest_filter=Manual/GroupOfCases.Passes/Peer WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
set_tests_properties(manual_Peer PROPERTIES LABELS peer TIMEOUT 1800 SKIP_REGULAR_EXPRESSION "SKIPPED")
