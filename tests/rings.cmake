mill_test(ring_sections_test LABEL unit LINK mill::bearing)
mill_test(bearing_rings_test LABEL verification TIMEOUT 120 LINK mill::fem mill::meshes mill::bearing)
