# Benches are installed if they are built.
set(own_targets ${PROJECT_NAME}_core ${ros_targets})
list(SORT own_targets)
list(SORT bench_targets)
install(TARGETS ${bench_targets} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION} OPTIONAL)
install(TARGETS ${own_targets}
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
install(DIRECTORY config examples icons launch media rviz DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
# Without copies in the development space: rosrun would find each of them twice there.
install(PROGRAMS scripts/charts/charts scripts/diff_drive_robot.py
  scripts/ground_truth_frame.py
  scripts/rolling_stone.py scripts/scene_snapshot.py scripts/scripted_drive.py scripts/scripted_gripper.py scripts/scripted_mower.py
  scripts/step_clock.py
  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY scripts/charts/charting DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION}
  PATTERN __pycache__ EXCLUDE)
install(FILES nodelet_plugins.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
if(with_rviz)
  install(FILES plugin_description.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
endif()
