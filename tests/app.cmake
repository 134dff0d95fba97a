mill_test(repo_rules_test LABEL rules)
mill_test(command_line_test LABEL verification TIMEOUT 600 LINK mill::core)
target_sources(command_line_test PRIVATE support/program.cpp)
target_compile_definitions(command_line_test PRIVATE MILLSTAND_PROGRAM="$<TARGET_FILE:millstand>")
