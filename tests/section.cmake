mill_test(section_body_test LABEL unit LINK mill::fem)
mill_test(fourier_roll_test LABEL verification TIMEOUT 300 LINK mill_fem_test_support)
