# The library of the fuzz targets in test/fuzz, and the program that libFuzzer drives. Tests use the
# library with any compiler; scripts/fuzz.sh builds the program with clang.
file(GLOB fuzz_sources CONFIGURE_DEPENDS test/fuzz/*.cpp test/fuzz/targets/*.cpp)
list(FILTER fuzz_sources EXCLUDE REGEX "_(test|main)\\.cpp$")
add_library(fuzz_targets STATIC EXCLUDE_FROM_ALL ${fuzz_sources})
function(set_fuzz_options target)
  set_own_options(${target})
  target_include_directories(${target} PRIVATE test ${PROJECT_SOURCE_DIR} ${generated_folder})
endfunction()
set_fuzz_options(fuzz_targets)
target_include_directories(fuzz_targets SYSTEM PRIVATE ${catkin_INCLUDE_DIRS})
target_precompile_headers(fuzz_targets PRIVATE ${ros_headers})
add_dependencies(fuzz_targets ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
if(${PROJECT_NAME}_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "${PROJECT_NAME}_FUZZ needs clang, which brings libFuzzer")
  endif()
  # Of the nodes only what the targets call, since sanitizers make compiling slow.
  target_sources(fuzz_targets PRIVATE src/nodes/base/event_queue.cpp src/nodes/base/node_options.cpp
    src/nodes/canopy/canopy_options.cpp src/nodes/canopy/plants_in_area.cpp
    src/nodes/crowd/crowd_events.cpp src/nodes/crowd/shards/part_join.cpp
    src/nodes/crowd/shards/waiting_borders.cpp src/nodes/cutters/cut_request.cpp
    src/nodes/cutters/cutter_follower.cpp src/nodes/cutters/followed_cutter.cpp
    src/nodes/forest/forest_inputs.cpp src/nodes/forest/grab_history.cpp
    src/nodes/forest/grab_manager.cpp src/nodes/forest/grab_manager_ticks.cpp
    src/nodes/forest/tree_requests.cpp src/nodes/bodies/robot_bodies_parts.cpp
    src/nodes/grass/cover/cover_join.cpp src/nodes/grass/cover/grass_cover.cpp
    src/nodes/grass/grass_events.cpp src/nodes/grass/grass_options.cpp
    src/nodes/grass/grass_sources.cpp src/nodes/grass/treads/near_treads.cpp
    src/nodes/shard_requests/shard_registry.cpp src/nodes/snapshots/event_journal.cpp
    src/nodes/snapshots/snapshot_folder.cpp)
  target_link_libraries(fuzz_targets PUBLIC ${PROJECT_NAME}_ros PNG::PNG)
  # One instruction set suffices: all give the same bits. clang takes a quarter of an hour for the
  # largest of these sources with checks of undefined behaviour; test.sh --sanitize checks them.
  file(GLOB_RECURSE highway_sources src/*.cpp)
  foreach(source ${highway_sources})
    file(STRINGS ${source} loops REGEX "foreach_target.h")
    if(loops)
      set_source_files_properties(${source} PROPERTIES COMPILE_DEFINITIONS HWY_COMPILE_ONLY_STATIC
        COMPILE_OPTIONS -fno-sanitize=undefined)
    endif()
  endforeach()
  function(add_fuzz_program name)
    add_executable(${name} EXCLUDE_FROM_ALL test/fuzz/fuzz_main.cpp)
    set_fuzz_options(${name})
    target_link_libraries(${name} PRIVATE fuzz_targets -fsanitize=fuzzer)
  endfunction()
  add_fuzz_program(fuzz)
else()
  target_link_libraries(fuzz_targets PUBLIC ${PROJECT_NAME}_nodes PNG::PNG)
endif()
