# Unit tests of the simulated cell, one file each.
set(sim_tests
    test_cell_layout
    test_convex_hulls
    test_depth_camera
    test_depth_sensor
    test_part_pile
    test_pick_judge
    test_simulated_cell)
