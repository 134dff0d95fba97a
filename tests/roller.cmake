mill_test(raceway_mesh_test LABEL unit LINK mill::fem mill::meshes)
mill_test(roller_contact_test LABEL unit LINK mill::fem mill::meshes)
