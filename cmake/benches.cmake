# physics_bench with the engines of others where their development packages are installed; nothing
# else knows of them.
file(GLOB tree_sources CONFIGURE_DEPENDS bench/trees/*.cpp)
target_sources(physics_bench PRIVATE ${tree_sources})
file(GLOB modal_sources CONFIGURE_DEPENDS bench/modal/*.cpp)
target_sources(modal_bench PRIVATE ${modal_sources} ${tree_sources})
pkg_check_modules(bullet QUIET IMPORTED_TARGET bullet)
pkg_check_modules(dart QUIET IMPORTED_TARGET dart)
pkg_check_modules(simbody QUIET IMPORTED_TARGET simbody)
find_library(mujoco_library mujoco)  # its CMake target names folders that Debian does not install
if(mujoco_library)
  add_library(mujoco_peer UNKNOWN IMPORTED)
  set_target_properties(mujoco_peer PROPERTIES IMPORTED_LOCATION ${mujoco_library})
endif()

function(add_peer name library)
  if(NOT TARGET ${library})
    return()
  endif()
  set_target_properties(${library} PROPERTIES INTERFACE_COMPILE_OPTIONS "")  # some ask for C++11
  string(TOUPPER ${name} flag)
  target_sources(physics_bench PRIVATE bench/peers/${name}_engine.cpp)
  target_compile_definitions(physics_bench PRIVATE WITH_${flag})
  target_link_libraries(physics_bench PRIVATE ${library})
  message(STATUS "physics_bench measures ${name}")
endfunction()
add_peer(bullet PkgConfig::bullet)
add_peer(dart PkgConfig::dart)
add_peer(mujoco mujoco_peer)
add_peer(simbody PkgConfig::simbody)
# Debian builds it with assertions, which change the size of its classes.
set_source_files_properties(bench/peers/simbody_engine.cpp PROPERTIES
  COMPILE_OPTIONS -UNDEBUG SKIP_PRECOMPILE_HEADERS ON)

# crowd_bench, likewise. FCL's own flags ask for vectors that Debian's build of it does not have.
file(GLOB crowd_bench_sources CONFIGURE_DEPENDS bench/crowd/*.cpp)
target_sources(crowd_bench PRIVATE ${crowd_bench_sources})
find_library(fcl_library fcl)
find_library(ccd_library ccd)
if(fcl_library AND ccd_library)
  add_library(fcl_peer OBJECT bench/peers/fcl_distance.cpp)
  set_own_options(fcl_peer)
  target_compile_options(fcl_peer PRIVATE -O2)
  target_include_directories(fcl_peer PRIVATE bench include)
  target_link_libraries(fcl_peer PRIVATE Eigen3::Eigen)
  target_compile_definitions(fcl_peer PUBLIC WITH_FCL)
  target_link_libraries(crowd_bench PRIVATE fcl_peer ${fcl_library} ${ccd_library})
  message(STATUS "crowd_bench measures fcl")
endif()

# state_bench, with the messages and the replicas of nodes.
target_include_directories(state_bench SYSTEM PRIVATE ${catkin_INCLUDE_DIRS})
target_link_libraries(state_bench PRIVATE ${PROJECT_NAME}_ros ${catkin_LIBRARIES})

# Measures everything and draws it: build the target `charts`; scripts/charts has the program.
add_custom_target(charts
  COMMAND ${CMAKE_COMMAND} -E env CMAKE_PREFIX_PATH=${CATKIN_DEVEL_PREFIX}
    ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/charts/charts --out ${PROJECT_BINARY_DIR}/charts
  DEPENDS ${bench_targets} USES_TERMINAL VERBATIM)

# Frame rates and pictures of rviz with our displays.
if(with_rviz)
  foreach(program rviz_frames rviz_film)
    add_executable(${program} EXCLUDE_FROM_ALL bench/rviz/${program}.cpp)
    set_own_options(${program})
    target_compile_definitions(${program} PRIVATE QT_NO_KEYWORDS)
    target_include_directories(${program} PRIVATE bench)
    target_include_directories(${program} SYSTEM PRIVATE ${catkin_INCLUDE_DIRS})
    target_link_libraries(${program} PRIVATE ${qt_widgets} OpenGL::GL ${catkin_LIBRARIES})
    list(APPEND bench_targets ${program})
  endforeach()
endif()
add_custom_target(benches DEPENDS ${bench_targets})
