mill_test(repo_rules_test LABEL rules)

# The program from outside, verb by verb.
foreach(name command_line_test verify_command_test bearing_command_test bite_command_test masses_command_test
             chatter_command_test hostile_places_test memory_limits_test)
  mill_test(${name} LABEL verification TIMEOUT 600 LINK mill::core)
  target_sources(${name} PRIVATE support/program.cpp)
  target_compile_definitions(${name} PRIVATE MILLSTAND_PROGRAM="$<TARGET_FILE:millstand>")
endforeach()

mill_test(contact_command_test LABEL verification TIMEOUT 600 LINK mill::core)
target_sources(contact_command_test PRIVATE support/program.cpp)
target_compile_definitions(contact_command_test PRIVATE MILLSTAND_PROGRAM="$<TARGET_FILE:millstand>")

mill_test(strip_flow_store_test LABEL unit LINK mill::app)
mill_test(bite_accuracy_test    LABEL unit LINK mill::app)
mill_test(roll_mesh_gain_test   LABEL unit LINK mill::app)

# No Eigen template of ours may replace the one inside Gmsh's library (see mill_options).
add_test(NAME exported_symbols_test
  COMMAND sh -c "nm -D --defined-only '$<TARGET_FILE:millstand>' >/dev/null && ! nm -D --defined-only '$<TARGET_FILE:millstand>' | grep -q Eigen")
set_tests_properties(exported_symbols_test PROPERTIES LABELS rules)
