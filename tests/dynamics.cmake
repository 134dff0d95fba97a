# Reference computations and parameter sets that the tests of dynamics/ share.
add_library(mill_dynamics_test_support STATIC support/exact_hold.cpp support/published_stand.cpp)
target_link_libraries(mill_dynamics_test_support PUBLIC mill::dynamics mill_test_support PRIVATE mill_options)

foreach(name mill_model_test modes_test horizontal_model_test solver_poles_test spectrum_test rolling_force_test
             response_test bearing_law_test)
  mill_test(${name} LABEL unit LINK mill_dynamics_test_support)
endforeach()
foreach(name exact_hold_test load_cell_test largest_response_test bearing_dynamics_test)
  mill_test(${name} LABEL verification LINK mill_dynamics_test_support)
endforeach()
foreach(name stand_variants_test twelve_tones_test load_dependence_test noise_levels_test force_records_test)
  mill_test(${name} LABEL regression LINK mill_dynamics_test_support)
endforeach()
add_dependencies(force_records_test make_records)
target_compile_definitions(force_records_test PRIVATE MAKE_RECORDS="$<TARGET_FILE:make_records>")
