# Tests of what the scripts in scripts/ are made of.
set(scripts_tests
    test_ablation
    test_claim
    test_help
    test_loops
    test_pins_seen
    test_real_scan
    test_real_scan_regions
    test_reliability
    test_reliability_scenes
    test_shiny)
