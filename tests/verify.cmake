mill_test(verification_test LABEL unit LINK mill::verify)

# The manual, one test per family of cases; a failure prints the table of the case.
add_executable(verification_manual_test verification/verification_manual_test.cpp)
target_link_libraries(verification_manual_test PRIVATE mill::verify mill_test_support mill_options)
target_compile_definitions(verification_manual_test PRIVATE MILLSTAND_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
foreach(family ClosedForms HalfSpaceCases SectionCases SolidCases FrictionCases NonlinearCases RollCases
               BearingCases RollerCases RingCases
               SlabCases InhomogeneousCases ElasticArcCases StripFlowCases StripElasticCases RollArcCases
               MassCases ComponentCases HousingCases
               ChatterStandCases ChatterMotionCases ChatterSensitivityCases ChatterTandemCases)
  add_test(NAME manual_${family}
    COMMAND verification_manual_test --gtest_filter=Manual.${family} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(manual_${family} PROPERTIES LABELS verification TIMEOUT 300)
endforeach()
