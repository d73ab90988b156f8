# Begins `cmake --install`: makes the folders that are not there yet, whatever the umask readable by everybody, and
# notes them for `uninstall`, which leaves those that were there before. DESTDIR is noted as well. Text, not lists: a
# bracket in the prefix would join the elements of a list.
cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_PREFIX NORMALIZE)  # the unit names it
set(root "$ENV{DESTDIR}")
if(root)
  cmake_path(ABSOLUTE_PATH root NORMALIZE)
  string(REGEX REPLACE "/$" "" root "${root}")
endif()
if("${root}${CMAKE_INSTALL_PREFIX}" MATCHES "[;\n]")
  message(FATAL_ERROR "install: the prefix has a \";\" or a line break, which CMake takes for a separator; nothing was installed; next: another --prefix")
endif()

# A part of an installation, as for a Debian package, notes nothing.
set(noted)
if(NOT CMAKE_INSTALL_COMPONENT AND EXISTS "${folders_file}")
  file(READ "${folders_file}" noted)
  string(REGEX REPLACE "^DESTDIR=[^\n]*\n" "" noted "${noted}")
endif()
if(NOT CMAKE_INSTALL_COMPONENT)
  file(WRITE "${folders_file}" "DESTDIR=${root}\n${noted}")
endif()

# make_folder(FOLDER): with those around it.
function(make_folder folder)
  if(NOT EXISTS "${folder}")
    get_filename_component(around "${folder}" DIRECTORY)
    make_folder("${around}")
    file(MAKE_DIRECTORY "${folder}")
    file(CHMOD "${folder}" PERMISSIONS ${readable} OWNER_EXECUTE GROUP_EXECUTE WORLD_EXECUTE)
    if(NOT CMAKE_INSTALL_COMPONENT)
      file(APPEND "${folders_file}" "${folder}\n")
    endif()
  endif()
endfunction()

if(NOT CMAKE_INSTALL_COMPONENT)
  foreach(folder ${folders})
    make_folder("${root}${CMAKE_INSTALL_PREFIX}/${folder}")
  endforeach()
endif()
