# Tests of what the simulator's programs read and write.
set(sim_node_tests test_cell_params test_sensor_params test_simulate_scene)
