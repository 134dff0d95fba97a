add_library(mill_fem_test_support STATIC support/roll_pair.cpp)
target_link_libraries(mill_fem_test_support PUBLIC mill::meshes mill::fem mill_options)

mill_test(roll_cache_test LABEL unit LINK mill::fem)
mill_test(sparse_test LABEL unit LINK mill::sparse)
mill_test(roll_mesh_test LABEL unit LINK mill_fem_test_support)
mill_test(line_contact_fem_test LABEL verification TIMEOUT 240 LINK mill_fem_test_support)
mill_test(roll_pair_test LABEL verification TIMEOUT 300 LINK mill_fem_test_support)
mill_test(whole_roll_test LABEL verification TIMEOUT 240 LINK mill_fem_test_support)
