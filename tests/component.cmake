mill_test(component_cache_test LABEL unit LINK mill::fem)
mill_test(component_modes_test LABEL unit LINK mill::meshes mill::fem)
