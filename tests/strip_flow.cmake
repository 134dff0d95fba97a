mill_test(strip_flow_test LABEL unit LINK mill::fem mill::meshes)
