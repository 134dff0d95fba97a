mill_test(roller_law_test       LABEL unit         LINK mill::bearing)
mill_test(bearing_geometry_test LABEL unit         LINK mill::bearing)
mill_test(rigid_rings_test      LABEL verification LINK mill::bearing)
