# Tests of what the command-line tools share, and of the tools as they are called.
set(tools_tests test_command_line test_pose_check)
