# The elastic-plastic strip in the bite: its material along a streamline, its solver's refusals and identities.
mill_test(strip_material_test LABEL unit TIMEOUT 120 LINK mill::fem)
