# Tests of what the command-line tools share, and of the tools as they are called; those of the second
# list read PPF_BIN_PICKING_DATA.
set(tools_tests test_bop_recall test_command_line test_evaluate_poses test_evaluation_summary
                test_pose_check test_pose_judgement)
set(tools_data_tests test_evaluators_agree)
