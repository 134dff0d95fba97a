# The roll bite by closed slab theories.
mill_test(derivative_test       LABEL unit         LINK mill::bite)
mill_test(bite_test             LABEL unit         LINK mill::bite)
mill_test(bite_corners_test     LABEL unit         LINK mill::bite)
mill_test(slab_theories_test    LABEL unit         LINK mill::bite)
mill_test(bite_slab_test        LABEL verification LINK mill::bite)
mill_test(slab_derivatives_test LABEL verification LINK mill::bite)
