mill_test(repo_rules_test LABEL rules)
mill_test(command_line_test LABEL verification TIMEOUT 600 LINK mill::core)
target_sources(command_line_test PRIVATE support/program.cpp)
target_compile_definitions(command_line_test PRIVATE MILLSTAND_PROGRAM="$<TARGET_FILE:millstand>")
mill_test(bearing_command_test LABEL verification TIMEOUT 300 LINK mill::core)
target_sources(bearing_command_test PRIVATE support/program.cpp)
target_compile_definitions(bearing_command_test PRIVATE MILLSTAND_PROGRAM="$<TARGET_FILE:millstand>")
mill_test(strip_flow_store_test LABEL unit LINK mill::app)
mill_test(bite_command_test LABEL verification TIMEOUT 300 LINK mill::core)
target_sources(bite_command_test PRIVATE support/program.cpp)
target_compile_definitions(bite_command_test PRIVATE MILLSTAND_PROGRAM="$<TARGET_FILE:millstand>")
mill_test(masses_command_test LABEL verification TIMEOUT 300 LINK mill::core)
target_sources(masses_command_test PRIVATE support/program.cpp)
target_compile_definitions(masses_command_test PRIVATE MILLSTAND_PROGRAM="$<TARGET_FILE:millstand>")

# No Eigen template of ours may replace the one inside Gmsh's library (see mill_options).
add_test(NAME exported_symbols_test
  COMMAND sh -c "nm -D --defined-only '$<TARGET_FILE:millstand>' >/dev/null && ! nm -D --defined-only '$<TARGET_FILE:millstand>' | grep -q Eigen")
set_tests_properties(exported_symbols_test PROPERTIES LABELS rules)
