# Contact of any two meshed bodies: coupling of surface grids, condensed surfaces, structured meshes.
mill_test(mortar_test LABEL unit LINK mill::contact mill::core)
mill_test(condensed_surface_test LABEL unit LINK mill::meshes mill::fem mill::contact)
mill_test(block_mesh_test LABEL unit LINK mill::meshes mill::fem)
