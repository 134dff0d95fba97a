mill_test(bite_roll_test      LABEL unit LINK mill::fem mill::meshes mill_options)
mill_test(path_stiffness_test LABEL unit LINK mill::bite mill_options)
