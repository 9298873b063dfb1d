#Unit tests of the simulated cell, one file each.
set(sim_tests test_bin_filling test_depth_camera test_depth_sensor test_simulated_cell)
