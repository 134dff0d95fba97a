mill_test(nonlinear_test LABEL unit LINK mill::fem mill::meshes)
