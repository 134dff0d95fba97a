# The manual, one entry per group of cases (verify::groups()); a failure prints the table of the case.
set(manual_groups ClosedForms HalfSpace Section Solid Friction Nonlinear Roll
                  Bearing Roller Ring OilFilm BearingMotion
                  Slab Inhomogeneous ElasticArc StripFlow StripElastic RollArc
                  Mass Component Housing Response
                  ChatterStand ChatterMotion ChatterSensitivity ChatterTandem)
# Those of them with cases of the long form (names_of_long_form).
set(long_groups Nonlinear Roll Roller Ring StripFlow StripElastic Component)
# verification_test compares these lists with the groups of the program: one that is missing here would never run.
string(REPLACE ";" "," all_groups "${manual_groups};Peer")
string(REPLACE ";" "," all_long_groups "${long_groups}")
mill_tests(verify LINK mill::verify mill::bite mill::fem_linked SUPPORT manual/manual_test.cpp DEFINE MANUAL_GROUPS="${all_groups}" LONG_GROUPS="${all_long_groups}")

math(EXPR manual_timeout "300 * ${MILLSTAND_SLOWER}")
foreach(group ${manual_groups})
  add_test(NAME manual_${group}
    COMMAND verify_tests --gtest_filter=Manual/GroupOfCases.Passes/${group} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(manual_${group} PROPERTIES LABELS verification TIMEOUT ${manual_timeout})
endforeach()

# The long form, "ctest -C long": studies on several meshes and the largest benchmarks ...
foreach(group ${long_groups})
  add_test(NAME manual_${group}_long CONFIGURATIONS long
    COMMAND verify_tests --gtest_filter=Long/GroupOfCases.Passes/${group} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(manual_${group}_long PROPERTIES LABELS long TIMEOUT 1800)
endforeach()
# ... and comparisons with CalculiX, skipped where it is not installed.
add_test(NAME manual_Peer CONFIGURATIONS long
  COMMAND verify_tests --gtest_filter=Manual/GroupOfCases.Passes/Peer WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
set_tests_properties(manual_Peer PROPERTIES LABELS peer TIMEOUT 1800 SKIP_REGULAR_EXPRESSION "SKIPPED")
