# Libraries and programs. A library takes all sources below its folders; in src/nodes, *_node.cpp is
# the program of a node and nodelets.cpp holds the nodelet plugins.
set(core_folders canopy core crowd dynamics forest grass reference sensors terrain tree wind)
list(TRANSFORM core_folders APPEND /*.cpp OUTPUT_VARIABLE core_patterns)
list(TRANSFORM core_patterns PREPEND src/)
file(GLOB_RECURSE core_sources CONFIGURE_DEPENDS ${core_patterns})
file(GLOB_RECURSE ros_sources CONFIGURE_DEPENDS src/ros/*.cpp)
file(GLOB_RECURSE node_sources CONFIGURE_DEPENDS src/nodes/*.cpp)
file(GLOB_RECURSE main_sources CONFIGURE_DEPENDS src/nodes/*_node.cpp)
set(nodelet_sources ${PROJECT_SOURCE_DIR}/src/nodes/nodelets.cpp)
file(GLOB_RECURSE rviz_sources CONFIGURE_DEPENDS src/rviz/*.cpp src/rviz/*.h)
file(GLOB bench_sources CONFIGURE_DEPENDS bench/*.cpp)
list(REMOVE_ITEM node_sources ${main_sources} ${nodelet_sources})

# The state must have the same bits on every processor, so multiplications and additions are not
# contracted into fused operations. Eigen must not vectorise unaligned vectors of three numbers: loads
# of pairs would wait for stores of single numbers, which costs a quarter of a physical step.
function(set_own_options target)
  target_compile_features(${target} PRIVATE cxx_std_17)
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic)
  target_compile_definitions(${target} PRIVATE EIGEN_UNALIGNED_VECTORIZE=0)
  target_include_directories(${target} PRIVATE src)
  if(${PROJECT_NAME}_DEVELOPER)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# The compiler reads the sources of a folder as one file, which takes a third of the time. Sources that
# Highway compiles once per instruction set stay on their own.
# usage: compile_by_folder(TARGET SOURCE ...)
function(compile_by_folder target)
  if(NOT ${PROJECT_NAME}_UNITY OR CMAKE_VERSION VERSION_LESS 3.18)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source ${ARGN})
    file(STRINGS ${source} repeated REGEX "hwy/foreach_target.h" LIMIT_COUNT 1)
    if(NOT repeated)
      get_filename_component(folder ${source} DIRECTORY)
      file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
      string(MAKE_C_IDENTIFIER ${folder} group)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
endfunction()

# Headers of other libraries that most sources of a folder include. A compiler reads each list once per
# target; headers of this package are not among them, because a change would compile everything again.
set(core_headers <algorithm> <array> <cmath> <cstdint> <functional> <map> <memory> <mutex> <optional>
  <set> <string> <utility> <vector> <Eigen/Geometry> <yaml-cpp/yaml.h>)
set(ros_headers ${core_headers} <ros/ros.h> <tf2_ros/buffer.h>)
set(rviz_headers ${ros_headers} <OgreSceneManager.h> <rviz/display.h> <rviz/display_context.h>
  <rviz/properties/float_property.h>)

# The core links no ROS library.
add_library(${PROJECT_NAME}_core ${core_sources})
compile_by_folder(${PROJECT_NAME}_core ${core_sources})
set_own_options(${PROJECT_NAME}_core)
target_precompile_headers(${PROJECT_NAME}_core PRIVATE ${core_headers})
target_include_directories(${PROJECT_NAME}_core PUBLIC include)
target_link_libraries(${PROJECT_NAME}_core
  PUBLIC Eigen3::Eigen ${YAML_CPP_LIBRARIES} PRIVATE PNG::PNG Threads::Threads hwy::hwy)

# Targets above the core use ROS.
add_library(${PROJECT_NAME}_ros ${ros_sources})
compile_by_folder(${PROJECT_NAME}_ros ${ros_sources})
target_link_libraries(${PROJECT_NAME}_ros PUBLIC ${PROJECT_NAME}_core PRIVATE PkgConfig::assimp)
target_precompile_headers(${PROJECT_NAME}_ros PRIVATE ${ros_headers})
add_library(${PROJECT_NAME}_nodes ${node_sources})
compile_by_folder(${PROJECT_NAME}_nodes ${node_sources})
target_link_libraries(${PROJECT_NAME}_nodes PUBLIC ${PROJECT_NAME}_ros)
target_precompile_headers(${PROJECT_NAME}_nodes PRIVATE ${ros_headers})
add_library(${PROJECT_NAME}_nodelets ${nodelet_sources})
target_link_libraries(${PROJECT_NAME}_nodelets PUBLIC ${PROJECT_NAME}_nodes)
set(ros_targets ${PROJECT_NAME}_ros ${PROJECT_NAME}_nodes ${PROJECT_NAME}_nodelets)
if(with_rviz)
  add_library(${PROJECT_NAME}_rviz ${rviz_sources})
  list(FILTER rviz_sources INCLUDE REGEX "[.]cpp$")
  compile_by_folder(${PROJECT_NAME}_rviz ${rviz_sources})
  target_compile_definitions(${PROJECT_NAME}_rviz PRIVATE QT_NO_KEYWORDS)
  target_link_libraries(${PROJECT_NAME}_rviz
    PUBLIC ${PROJECT_NAME}_ros ${qt_widgets} PRIVATE OpenGL::GL)
  set_target_properties(${PROJECT_NAME}_rviz PROPERTIES AUTOMOC ON)
  target_precompile_headers(${PROJECT_NAME}_rviz PRIVATE ${rviz_headers})
  # The library stays loaded after rviz unloads it: a pending service call may still return into it.
  target_link_options(${PROJECT_NAME}_rviz PRIVATE LINKER:-z,nodelete)
  list(APPEND ros_targets ${PROJECT_NAME}_rviz)
endif()
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

# Adds a library without code whose precompiled headers programs with the same options share.
# usage: add_shared_headers(NAME LIBRARY HEADER ...)
set(generated_folder ${PROJECT_BINARY_DIR}/generated)
file(GENERATE OUTPUT ${generated_folder}/empty.cpp CONTENT "")
function(add_shared_headers name library)
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${generated_folder}/empty.cpp)
  set_own_options(${name})
  target_link_libraries(${name} PRIVATE ${library})
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

# Benches share the folder scenes with the tests; the target benches builds them. Only the files that
# need the folder of the package include its path, so that a compiler cache serves every clone.
configure_file(cmake/package_folder.h.in ${generated_folder}/package_folder.h @ONLY)
add_shared_headers(bench_headers ${PROJECT_NAME}_core ${core_headers})
foreach(source ${bench_sources})
  get_filename_component(bench ${source} NAME_WE)
  add_executable(${bench} EXCLUDE_FROM_ALL ${source})
  set_own_options(${bench})
  target_include_directories(${bench} PRIVATE bench ${PROJECT_SOURCE_DIR} ${generated_folder})
  target_link_libraries(${bench} PRIVATE ${PROJECT_NAME}_core)
  target_precompile_headers(${bench} REUSE_FROM bench_headers)
  list(APPEND bench_targets ${bench})
endforeach()
