# Libraries and programs. A folder's sources are its *.cpp files; in src/nodes, *_node.cpp is the
# program of a node and nodelets.cpp has their plugins.
file(GLOB core_sources CONFIGURE_DEPENDS
  src/canopy/*.cpp src/common/*.cpp src/crowd/*.cpp src/forest/*.cpp src/grass/*.cpp src/physics/*.cpp src/scan/*.cpp src/terrain/*.cpp src/wind/*.cpp)
# Vectors of three numbers go through memory one by one: pairs of them would wait for stores of
# singles, a quarter of a physical step.
file(GLOB physics_sources CONFIGURE_DEPENDS src/physics/*.cpp)
set_source_files_properties(${physics_sources} PROPERTIES
  COMPILE_DEFINITIONS EIGEN_UNALIGNED_VECTORIZE=0)
file(GLOB ros_sources CONFIGURE_DEPENDS src/ros/*.cpp)
file(GLOB node_sources CONFIGURE_DEPENDS src/nodes/*.cpp)
file(GLOB main_sources CONFIGURE_DEPENDS src/nodes/*_node.cpp)
set(nodelet_sources ${PROJECT_SOURCE_DIR}/src/nodes/nodelets.cpp)
file(GLOB rviz_sources CONFIGURE_DEPENDS src/rviz/*.cpp include/${PROJECT_NAME}/rviz/*.h)
file(GLOB bench_sources CONFIGURE_DEPENDS bench/*.cpp)
list(REMOVE_ITEM node_sources ${main_sources} ${nodelet_sources})

# No contraction into fused multiply-add: state is the same to the bit on every processor.
function(set_own_options target)
  target_compile_features(${target} PRIVATE cxx_std_17)
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic)
  target_include_directories(${target} PRIVATE src)
  if(${PROJECT_NAME}_DEVELOPER)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# The core links no ROS library.
add_library(${PROJECT_NAME}_core ${core_sources})
set_own_options(${PROJECT_NAME}_core)
target_include_directories(${PROJECT_NAME}_core PUBLIC include)
target_link_libraries(${PROJECT_NAME}_core
  PUBLIC Eigen3::Eigen ${YAML_CPP_LIBRARIES} PRIVATE PNG::PNG hwy::hwy)

# Above the core everybody sees ROS.
add_library(${PROJECT_NAME}_ros ${ros_sources})
target_link_libraries(${PROJECT_NAME}_ros PUBLIC ${PROJECT_NAME}_core PRIVATE PkgConfig::assimp)
add_library(${PROJECT_NAME}_nodes ${node_sources})
target_link_libraries(${PROJECT_NAME}_nodes PUBLIC ${PROJECT_NAME}_ros)
add_library(${PROJECT_NAME}_nodelets ${nodelet_sources})
target_link_libraries(${PROJECT_NAME}_nodelets PUBLIC ${PROJECT_NAME}_nodes)
add_library(${PROJECT_NAME}_rviz ${rviz_sources})
target_compile_definitions(${PROJECT_NAME}_rviz PRIVATE QT_NO_KEYWORDS)
target_link_libraries(${PROJECT_NAME}_rviz
  PUBLIC ${PROJECT_NAME}_ros Qt5::Widgets PRIVATE OpenGL::GL)
set_target_properties(${PROJECT_NAME}_rviz PROPERTIES AUTOMOC ON)
# A call that a node has not answered yet returns into this library, when rviz has unloaded it too.
target_link_options(${PROJECT_NAME}_rviz PRIVATE LINKER:-z,nodelete)

set(ros_targets
  ${PROJECT_NAME}_ros ${PROJECT_NAME}_nodes ${PROJECT_NAME}_nodelets ${PROJECT_NAME}_rviz)
foreach(source ${main_sources})
  get_filename_component(node ${source} NAME_WE)
  string(REGEX REPLACE "_node$" "" node ${node})
  add_executable(${node} ${source})
  target_link_libraries(${node} PUBLIC ${PROJECT_NAME}_nodes)
  list(APPEND ros_targets ${node})
endforeach()
add_executable(export_forest src/tools/export_forest.cpp)
target_link_libraries(export_forest PUBLIC ${PROJECT_NAME}_nodes)
list(APPEND ros_targets export_forest)
foreach(target ${ros_targets})
  set_own_options(${target})
  target_include_directories(${target} SYSTEM PRIVATE ${catkin_INCLUDE_DIRS})
  target_link_libraries(${target} PUBLIC ${catkin_LIBRARIES})
  add_dependencies(${target} ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
endforeach()

# Benches share their scenes with the tests.
foreach(source ${bench_sources})
  get_filename_component(bench ${source} NAME_WE)
  add_executable(${bench} ${source})
  set_own_options(${bench})
  target_include_directories(${bench} PRIVATE bench test)
  target_compile_definitions(${bench} PRIVATE PACKAGE_FOLDER="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${bench} PRIVATE ${PROJECT_NAME}_core)
  list(APPEND bench_targets ${bench})
endforeach()
