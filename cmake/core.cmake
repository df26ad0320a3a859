# The core, which links no ROS library, and the options of compilation that all targets share.
# test/golden/CMakeLists.txt includes this file too, without catkin. Needs package_root.
set(core_folders canopy core crowd dynamics forest grass reference sensors terrain tree wind)
list(TRANSFORM core_folders APPEND /*.cpp OUTPUT_VARIABLE core_patterns)
list(TRANSFORM core_patterns PREPEND ${package_root}/src/)
file(GLOB_RECURSE core_sources CONFIGURE_DEPENDS ${core_patterns})

# The state must have the same bits on every processor, so multiplications and additions are not
# contracted into fused operations. Eigen must not vectorise unaligned vectors of three numbers: loads
# of pairs would wait for stores of single numbers, which costs a quarter of a physical step.
function(set_own_options target)
  target_compile_features(${target} PRIVATE cxx_std_17)
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic)
  target_compile_definitions(${target} PRIVATE EIGEN_UNALIGNED_VECTORIZE=0)
  # Highway asks for the cryptographic instructions of ARM64 in its own functions. Without them here,
  # GCC rejects structures of vectors, whose constructors it makes. No code is made of them.
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
    target_compile_options(${target} PRIVATE -march=armv8-a+crypto)
  endif()
  target_include_directories(${target} PRIVATE ${package_root}/src)
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
      file(RELATIVE_PATH folder ${package_root} ${folder})
      string(MAKE_C_IDENTIFIER ${folder} group)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
endfunction()

# Headers of other libraries that most sources of a folder include. A compiler reads each list once per
# target; headers of this package are not among them, because a change would compile everything again.
set(core_headers <algorithm> <array> <cmath> <cstdint> <functional> <map> <memory> <mutex> <optional>
  <set> <string> <utility> <vector> <Eigen/Geometry> <yaml-cpp/yaml.h>)

add_library(${PROJECT_NAME}_core ${core_sources})
compile_by_folder(${PROJECT_NAME}_core ${core_sources})
set_own_options(${PROJECT_NAME}_core)
target_precompile_headers(${PROJECT_NAME}_core PRIVATE ${core_headers})
target_include_directories(${PROJECT_NAME}_core PUBLIC ${package_root}/include)
target_link_libraries(${PROJECT_NAME}_core
  PUBLIC Eigen3::Eigen ${YAML_CPP_LIBRARIES} PRIVATE PNG::PNG Threads::Threads hwy::hwy)
