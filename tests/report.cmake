# A run directory made from closed forms, for every test of the report.
add_library(mill_sample_run STATIC support/sample_bearing.cpp support/sample_results.cpp support/sample_run.cpp)
target_link_libraries(mill_sample_run PUBLIC mill_test_support)

mill_test(number_test       LABEL unit LINK mill::report)
mill_test(curves_test      LABEL unit LINK mill::report)
mill_test(ticks_test        LABEL unit LINK mill::report)
mill_test(envelope_test     LABEL unit LINK mill::report)
mill_test(svg_plot_test     LABEL unit LINK mill::report)
mill_test(run_test          LABEL unit LINK mill::report mill_sample_run)
mill_test(html_report_test  LABEL unit LINK mill::report mill_sample_run)
mill_test(bearing_report_test LABEL unit LINK mill::report mill_sample_run)
mill_test(bite_report_test LABEL unit LINK mill::report mill_sample_run)
mill_test(model_report_test LABEL unit LINK mill::report mill_sample_run)
