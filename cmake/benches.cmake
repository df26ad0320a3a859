# physics_bench with the engines of others where their development packages are installed; nothing
# else knows of them.
file(GLOB tree_sources CONFIGURE_DEPENDS bench/trees/*.cpp)
target_sources(physics_bench PRIVATE ${tree_sources})
pkg_check_modules(bullet QUIET IMPORTED_TARGET bullet)
pkg_check_modules(dart QUIET IMPORTED_TARGET dart)
find_library(mujoco_library mujoco)  # its CMake target names folders that Debian does not install
if(mujoco_library)
  add_library(mujoco_peer UNKNOWN IMPORTED)
  set_target_properties(mujoco_peer PROPERTIES IMPORTED_LOCATION ${mujoco_library})
endif()

function(add_peer name library)
  if(NOT TARGET ${library})
    return()
  endif()
  set_target_properties(${library} PROPERTIES INTERFACE_COMPILE_OPTIONS "")  # DART asks for C++11
  string(TOUPPER ${name} flag)
  target_sources(physics_bench PRIVATE bench/peers/${name}_engine.cpp)
  target_compile_definitions(physics_bench PRIVATE WITH_${flag})
  target_link_libraries(physics_bench PRIVATE ${library})
  message(STATUS "physics_bench measures ${name}")
endfunction()
add_peer(bullet PkgConfig::bullet)
add_peer(dart PkgConfig::dart)
add_peer(mujoco mujoco_peer)
