# Highway: its package where the system has one, else its source, which is fetched at the first
# configuration. Without a network, set FETCHCONTENT_SOURCE_DIR_HIGHWAY to a folder with the source.
find_package(hwy QUIET)
if(NOT TARGET hwy::hwy)  # an installation of Highway itself has no CMake files
  pkg_check_modules(hwy QUIET IMPORTED_TARGET GLOBAL libhwy)
  if(hwy_FOUND)
    add_library(hwy::hwy ALIAS PkgConfig::hwy)
  endif()
endif()

if(NOT TARGET hwy::hwy)
  message(STATUS "Highway is not installed: its release 1.0.3 is fetched and built")
  include(FetchContent)
  # These are options of Highway. It becomes a part of the core's shared library.
  #catkin_lint: ignore global_var_collision
  foreach(part CONTRIB EXAMPLES INSTALL TESTS)
    set(HWY_ENABLE_${part} OFF CACHE INTERNAL "")
  endforeach()
  set(HWY_FORCE_STATIC_LIBS ON CACHE INTERNAL "")
  #catkin_lint: report global_var_collision
  fetchcontent_declare(highway
    URL https://github.com/google/highway/archive/refs/tags/1.0.3.tar.gz
      https://deb.debian.org/debian/pool/main/h/highway/highway_1.0.3.orig.tar.gz
    URL_HASH SHA256=566fc77315878473d9a6bd815f7de78c73734acdcb745c3dde8579560ac5440e)
  fetchcontent_makeavailable(highway)
  set_target_properties(hwy PROPERTIES POSITION_INDEPENDENT_CODE ON)
  add_library(hwy::hwy ALIAS hwy)
endif()
