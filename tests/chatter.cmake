# Chatter: the bite, the stand and the strip coupled.
mill_test(chatter_structure_test   LABEL unit         LINK mill::dynamics)
mill_test(critical_speed_test      LABEL unit         LINK mill::dynamics)
mill_test(routh_test               LABEL unit         LINK mill::dynamics)
mill_test(chatter_run_test         LABEL verification LINK mill::dynamics)
mill_test(chatter_sensitivity_test LABEL unit         LINK mill::dynamics)
mill_test(stability_map_test       LABEL unit         LINK mill::dynamics)
mill_test(tandem_test              LABEL verification LINK mill::dynamics)
