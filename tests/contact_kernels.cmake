mill_test(hertz_test      LABEL unit LINK mill::contact)
mill_test(half_space_test LABEL unit LINK mill::contact)
