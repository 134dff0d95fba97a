# The roll bite by integrated slab theories and elastic arcs.
mill_test(karman_test      LABEL unit LINK mill::bite)
mill_test(elastic_arc_test LABEL unit LINK mill::bite)
