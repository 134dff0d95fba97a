mill_test(screwdown_test LABEL unit LINK mill::reduce)
mill_test(housing_frame_test LABEL unit LINK mill::reduce)
mill_test(housing_test LABEL unit LINK mill::meshes mill::fem)
