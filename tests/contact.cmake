foreach(name active_set_test continuation_test friction_test projected_gradient_test)
  mill_test(${name} LABEL unit LINK mill::contact)
endforeach()
