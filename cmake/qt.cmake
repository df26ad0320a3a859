# Finds the Qt with which rviz is built: a process cannot have both. rviz does not say which it is,
# but the name of that library is in its own. Sets qt_widgets to the name of the target.
set(qt Qt5)
foreach(library ${rviz_LIBRARIES})
  if(library MATCHES "librviz[.]so$")
    file(STRINGS ${library} qt6_names REGEX "libQt6Widgets" LIMIT_COUNT 1)
    if(qt6_names)
      set(qt Qt6)
    endif()
  endif()
endforeach()
find_package(${qt} QUIET COMPONENTS Widgets)
set(qt_widgets ${qt}::Widgets)
